//! Typed access to a JSON document that remembers where it is.

use serde_json::Value;

use crate::scene::error::Fault;

/// A value of the document and its JSON pointer.
#[derive(Clone, Debug)]
pub struct Item<'a> {
    value: &'a Value,
    place: String,
}

impl<'a> Item<'a> {
    /// The whole document.
    pub fn root(value: &'a Value) -> Self {
        Self {
            value,
            place: String::new(),
        }
    }

    /// JSON pointer to this value.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// A fault at this value.
    pub fn fault(&self, reason: impl Into<String>) -> Fault {
        let place = if self.place.is_empty() {
            "/"
        } else {
            &self.place
        };
        Fault::new(place, reason)
    }

    fn expected(&self, what: &str) -> Fault {
        let found = match self.value {
            Value::Null => "null".to_owned(),
            Value::Bool(_) => "a boolean".to_owned(),
            Value::Number(n) => n.to_string(),
            Value::String(_) => "a string".to_owned(),
            Value::Array(a) => format!("an array of {}", a.len()),
            Value::Object(_) => "an object".to_owned(),
        };
        self.fault(format!("expected {what}, found {found}"))
    }

    fn child(&self, key: impl std::fmt::Display, value: &'a Value) -> Self {
        Self {
            value,
            place: format!("{}/{key}", self.place),
        }
    }

    /// The member `key` of this object; `None` where it is absent.
    pub fn get(&self, key: &str) -> Option<Self> {
        self.value.get(key).map(|value| self.child(key, value))
    }

    /// The member `key`, which must be there.
    pub fn require(&self, key: &str) -> Result<Self, Fault> {
        self.get(key)
            .ok_or_else(|| self.fault(format!("lacks the required \"{key}\"")))
    }

    /// The extension object `name` of this object.
    pub fn extension(&self, name: &str) -> Option<Self> {
        self.get("extensions")?.get(name)
    }

    /// The array `key`, empty where it is absent.
    pub fn array(&self, key: &str) -> Result<Vec<Self>, Fault> {
        let Some(item) = self.get(key) else {
            return Ok(Vec::new());
        };
        let values = item
            .value
            .as_array()
            .ok_or_else(|| item.expected("an array"))?;
        Ok(values
            .iter()
            .enumerate()
            .map(|(i, value)| item.child(i, value))
            .collect())
    }

    /// The array `key` of objects, empty where it is absent.
    pub fn objects(&self, key: &str) -> Result<Vec<Self>, Fault> {
        let items = self.array(key)?;
        match items.iter().find(|item| !item.value.is_object()) {
            Some(item) => Err(item.expected("an object")),
            None => Ok(items),
        }
    }

    /// This value as a count, offset or index.
    pub fn as_usize(&self) -> Result<usize, Fault> {
        // Some writers spell integers as 3.0, which JSON does not distinguish.
        let integer = self.value.as_u64().or_else(|| {
            let x = self.value.as_f64()?;
            (x >= 0.0 && x <= f64::from(u32::MAX) && x.fract() == 0.0).then_some(x as u64)
        });
        integer
            .and_then(|n| usize::try_from(n).ok())
            .ok_or_else(|| self.expected("a whole number of at least 0"))
    }

    /// This value as an index below `count` into the document's `array`.
    pub fn as_index(&self, array: &str, count: usize) -> Result<usize, Fault> {
        let index = self.as_usize()?;
        if index < count {
            Ok(index)
        } else {
            Err(self.fault(format!(
                "refers to {array}/{index}, but there are {count} {array}"
            )))
        }
    }

    /// This value as text.
    pub fn as_str(&self) -> Result<&'a str, Fault> {
        self.value.as_str().ok_or_else(|| self.expected("a string"))
    }

    /// This value as a finite number.
    pub fn as_f64(&self) -> Result<f64, Fault> {
        self.value
            .as_f64()
            .filter(|x| x.is_finite())
            .ok_or_else(|| self.expected("a number"))
    }

    /// The whole number `key`, or `default` where it is absent.
    pub fn usize_or(&self, key: &str, default: usize) -> Result<usize, Fault> {
        self.get(key).map_or(Ok(default), |item| item.as_usize())
    }

    /// The index `key` below `count` into the document's `array`.
    pub fn index(&self, key: &str, array: &str, count: usize) -> Result<Option<usize>, Fault> {
        self.get(key)
            .map(|item| item.as_index(array, count))
            .transpose()
    }

    /// The number `key`, or `default` where it is absent.
    pub fn f64_or(&self, key: &str, default: f64) -> Result<f64, Fault> {
        self.get(key).map_or(Ok(default), |item| item.as_f64())
    }

    /// The number `key` in single precision, or `default` where it is absent.
    pub fn f32_or(&self, key: &str, default: f32) -> Result<f32, Fault> {
        let Some(item) = self.get(key) else {
            return Ok(default);
        };
        let x = item.as_f64()? as f32;
        if x.is_finite() {
            Ok(x)
        } else {
            Err(item.expected("a number within single precision"))
        }
    }

    /// The boolean `key`, false where it is absent.
    pub fn flag(&self, key: &str) -> Result<bool, Fault> {
        self.get(key).map_or(Ok(false), |item| {
            item.value
                .as_bool()
                .ok_or_else(|| item.expected("true or false"))
        })
    }

    /// The text `key`.
    pub fn text(&self, key: &str) -> Result<Option<&'a str>, Fault> {
        self.get(key).map(|item| item.as_str()).transpose()
    }

    /// The `name`, which is never worth failing for.
    pub fn name(&self) -> Option<String> {
        self.text("name").ok().flatten().map(str::to_owned)
    }

    /// This value as finite numbers.
    pub fn as_numbers(&self) -> Result<Vec<f64>, Fault> {
        self.value
            .as_array()
            .and_then(|array| {
                let number = |v: &Value| v.as_f64().filter(|x| x.is_finite());
                array.iter().map(number).collect()
            })
            .ok_or_else(|| self.expected("an array of numbers"))
    }

    /// The `N` numbers `key`.
    pub fn numbers<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>, Fault> {
        let Some(item) = self.get(key) else {
            return Ok(None);
        };
        <[f64; N]>::try_from(item.as_numbers()?)
            .map(Some)
            .map_err(|_| item.expected(&format!("{N} numbers")))
    }
}
