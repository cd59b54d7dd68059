//! Files of unsupported formats, recognised by their first bytes.

/// First bytes of a format's files, its name, and a program that opens it.
const FORMATS: [(&[u8], &str, &str); 15] = [
    (b"Kaydara FBX Binary", "an FBX file", FROM_BLENDER),
    (b"; FBX ", "an FBX file", FROM_BLENDER),
    (b"BLENDER", "a Blender file", FROM_BLENDER),
    (b"PXR-USDC", "a USD file", FROM_BLENDER),
    (b"#usda", "a USD file", FROM_BLENDER),
    (b"MM\0*", "a TIFF image", "convert it to PNG"),
    (b"MM", "a 3DS file", "convert it to glTF with `assimp export IN OUT.glb`"),
    (b"ISO-10303-21", "a STEP file", "convert it to glTF with FreeCAD"),
    (b"PK\x03\x04", "a ZIP archive", "unpack it; a .usdz or .3mf file becomes glTF in Blender"),
    (b"\x1F\x8B", "a gzip archive", "unpack it with `gunzip`"),
    (
        b"\x28\xB5\x2F\xFD",
        "Zstandard data",
        "a .blend file is saved so: export glTF from Blender; otherwise unpack it with `unzstd`",
    ),
    (b"\x89PNG", "a PNG image", PHOTOGRAPH),
    (b"\xFF\xD8\xFF", "a JPEG image", PHOTOGRAPH),
    (b"\x76\x2F\x31\x01", "an EXR image", LIGHT),
    (b"#?RADIANCE", "a Radiance image", LIGHT),
];

const FROM_BLENDER: &str = "open it in Blender and export glTF (File, Export, glTF 2.0)";
const PHOTOGRAPH: &str = "`gpc zoom` enlarges parts of photographs";
const LIGHT: &str = "it can light a scene as `gpc render SCENE --environment FILE`";

/// Description of a file in an unsupported format, and advice.
pub fn hint(bytes: &[u8]) -> Option<String> {
    let known = FORMATS.iter().find(|(magic, ..)| bytes.starts_with(magic));
    if let Some((_, name, help)) = known {
        return Some(format!("this is {name}, not glTF, OBJ, STL or PLY; {help}"));
    }
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(512)]);
    if start.contains("<COLLADA") {
        return Some(format!("this is a COLLADA file, not glTF, OBJ, STL or PLY; {FROM_BLENDER}"));
    }
    if start.trim_start().to_lowercase().starts_with("<!doctype html") || start.contains("<html") {
        return Some("this is a web page, not the file itself; download the file again".to_owned());
    }
    None
}

#[cfg(test)]
mod tests {
    use super::hint;

    #[test]
    fn other_formats_are_named_with_what_helps() {
        for (bytes, expected) in [
            (&b"Kaydara FBX Binary  \0"[..], ["FBX", "Blender"]),
            (b"<?xml version=\"1.0\"?>\n<COLLADA xmlns", ["COLLADA", "Blender"]),
            (b"PK\x03\x04rest", ["ZIP", "unpack"]),
            (b"<!DOCTYPE html>", ["web page", "download"]),
            (b"\x89PNG\r\n", ["PNG", "gpc zoom"]),
        ] {
            let hint = hint(bytes).unwrap();
            assert!(expected.iter().all(|text| hint.contains(text)), "{hint}");
        }
        assert_eq!(hint(b"neither of these"), None);
        assert_eq!(hint(b""), None);
    }
}
