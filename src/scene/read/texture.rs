//! Textures and samplers (glTF 2.0, sections 3.8.1 to 3.8.4) with `EXT_texture_webp`.

use std::collections::{BTreeMap, BTreeSet};

use super::{Context, image::Images, json::Item};
use crate::scene::{
    error::Fault,
    material::{Filter, Image, Material, Sampler, Texture, Wrap},
};

/// Replaces the file's texture indices in `materials` by indices into the textures returned. Only
/// what the materials use is decoded; a texture without a readable image is left out of them.
pub fn resolve(
    context: &mut Context<'_>,
    materials: &mut [Material],
) -> Result<(Vec<Texture>, Vec<Image>), Fault> {
    let items = context.root.objects("textures")?;
    let mut images = Images::new(&context.root)?;
    let used: BTreeSet<u32> = materials
        .iter()
        .flat_map(Material::textures)
        .map(|t| t.texture)
        .collect();
    let wanted: Vec<(u32, Wanted)> = used
        .into_iter()
        .filter_map(|index| {
            let item = items.get(index as usize)?;
            let wanted = read_texture(item, context, images.len());
            Some((
                index,
                context.tolerate(wanted.map(Some), "the texture is left out")?,
            ))
        })
        .collect();

    images.decode(context, wanted.iter().filter_map(|(_, w)| w.preferred()));
    let failed = wanted
        .iter()
        .filter(|(_, w)| w.preferred().is_some_and(|i| images.place(i).is_none()));
    let fallbacks: Vec<usize> = failed.filter_map(|(_, w)| w.fallback).collect();
    images.decode(context, fallbacks);

    let mut textures = Vec::new();
    let mut places = BTreeMap::new();
    for (index, wanted) in wanted {
        let candidates = [wanted.webp, wanted.fallback];
        let Some(image) = candidates
            .into_iter()
            .flatten()
            .find_map(|i| images.place(i))
        else {
            context.warn(&Fault::new(
                format!("/textures/{index}"),
                "has no readable image and is left out",
            ));
            continue;
        };
        places.insert(index, textures.len() as u32);
        textures.push(Texture {
            image,
            sampler: wanted.sampler,
        });
    }
    for slot in materials.iter_mut().flat_map(Material::texture_slots) {
        *slot = slot.and_then(|mut used| {
            used.texture = *places.get(&used.texture)?;
            Some(used)
        });
    }
    Ok((textures, images.into_decoded()))
}

/// A texture of the file: the images that it offers, best first, and its sampler.
struct Wanted {
    webp: Option<usize>,
    fallback: Option<usize>,
    sampler: Sampler,
}

impl Wanted {
    fn preferred(&self) -> Option<usize> {
        self.webp.or(self.fallback)
    }
}

fn read_texture(
    item: &Item<'_>,
    context: &mut Context<'_>,
    images: usize,
) -> Result<Wanted, Fault> {
    let webp = match item.extension("EXT_texture_webp") {
        Some(extension) => context.tolerate(
            extension.index("source", "images", images),
            "the fallback is used",
        ),
        None => None,
    };
    let fallback = item.index("source", "images", images)?;
    let samplers = context.root.objects("samplers")?;
    let sampler = item
        .index("sampler", "samplers", samplers.len())
        .and_then(|index| {
            let item = index.and_then(|index| samplers.get(index));
            item.map(read_sampler).transpose()
        });
    Ok(Wanted {
        webp,
        fallback,
        sampler: context
            .tolerate(sampler, "the sampler takes the defaults")
            .unwrap_or_default(),
    })
}

fn read_sampler(item: &Item<'_>) -> Result<Sampler, Fault> {
    let code = |key: &str| item.get(key).map(|code| code.as_usize()).transpose();
    let mut sampler = Sampler::default();
    sampler.mag = match code("magFilter")? {
        None => sampler.mag,
        Some(9728) => Filter::Nearest,
        Some(9729) => Filter::Linear,
        Some(other) => return Err(item.fault(format!("{other} is no magnification filter"))),
    };
    (sampler.min, sampler.mip) = match code("minFilter")? {
        None => (sampler.min, sampler.mip),
        Some(9728) => (Filter::Nearest, None),
        Some(9729) => (Filter::Linear, None),
        Some(9984) => (Filter::Nearest, Some(Filter::Nearest)),
        Some(9985) => (Filter::Linear, Some(Filter::Nearest)),
        Some(9986) => (Filter::Nearest, Some(Filter::Linear)),
        Some(9987) => (Filter::Linear, Some(Filter::Linear)),
        Some(other) => return Err(item.fault(format!("{other} is no minification filter"))),
    };
    let wrap = |key: &str| {
        Ok(match code(key)? {
            None | Some(10_497) => Wrap::Repeat,
            Some(33_648) => Wrap::MirroredRepeat,
            Some(33_071) => Wrap::ClampToEdge,
            Some(other) => return Err(item.fault(format!("{other} is no wrapping mode"))),
        })
    };
    sampler.wrap_u = wrap("wrapS")?;
    sampler.wrap_v = wrap("wrapT")?;
    Ok(sampler)
}
