//! Textures and samplers (glTF 2.0, sections 3.8.1 to 3.8.4) with `KHR_texture_basisu` and
//! `EXT_texture_webp`.

use std::collections::{BTreeMap, BTreeSet};

use gltf::json::{
    self, Index,
    texture::{MagFilter, MinFilter},
};

use super::{
    Context,
    image::DecodedImages,
    model::{self, Model},
};
use crate::scene::{
    error::Fault,
    material::{Image, Material, Sampler, Texture},
};

/// Extensions that give a texture another image, in order of preference.
const SOURCES: [&str; 2] = ["KHR_texture_basisu", "EXT_texture_webp"];

/// The extension object.
#[derive(serde::Deserialize)]
struct TextureSource {
    source: Index<json::Image>,
}

/// Replaces the file's texture indices in `materials` by indices into the returned textures. Only images that
/// materials use are decoded; a texture without a readable image is removed from the materials.
pub fn resolve(context: &mut Context<'_>, materials: &mut [Material]) -> (Vec<Texture>, Vec<Image>) {
    let mut images = DecodedImages::default();
    let uses = materials.iter().flat_map(Material::textures);
    let used: BTreeSet<u32> = uses.map(|(_, used)| used.texture).collect();
    let mut wanted = Vec::new();
    for index in used {
        let found = context.model.get(Index::new(index), "/textures").map(Some);
        if let Some((item, place)) = context.tolerate(found, "the texture is left out") {
            let sampler = read_sampler(item, &place, context.model).map(Some);
            let sampler = context.tolerate(sampler, "the sampler takes the defaults");
            wanted.push((index, sources(item, &place, context), sampler.unwrap_or_default()));
        }
    }
    // First the preferred images of all textures are decoded together, then the alternatives for those that failed.
    for rank in 0..=SOURCES.len() {
        let failed = |sources: &Vec<usize>| !sources.iter().any(|&i| images.place(i).is_some());
        let next = wanted.iter().filter(|(_, sources, _)| failed(sources));
        let next: Vec<usize> = next.filter_map(|(_, s, _)| s.get(rank).copied()).collect();
        images.decode(context, next);
    }

    let mut textures = Vec::new();
    let mut places = BTreeMap::new();
    for (index, sources, sampler) in wanted {
        let Some(image) = sources.into_iter().find_map(|i| images.place(i)) else {
            let reason = "has no readable image and is left out";
            context.warn(&Fault::new(format!("/textures/{index}"), reason));
            continue;
        };
        places.insert(index, textures.len() as u32);
        textures.push(Texture { image, sampler });
    }
    for (_, slot) in materials.iter_mut().flat_map(Material::texture_slots) {
        *slot = slot.and_then(|mut used| {
            used.texture = *places.get(&used.texture)?;
            Some(used)
        });
    }
    (textures, images.into_decoded())
}

/// Indices of the images that a texture offers, in order of preference.
fn sources(item: &json::Texture, place: &str, context: &mut Context<'_>) -> Vec<usize> {
    let others = item.extensions.as_ref().map(|extensions| &extensions.others);
    let mut sources = Vec::new();
    for name in SOURCES {
        let source = model::extension::<TextureSource>(others, name, place).and_then(|found| {
            let Some((TextureSource { source }, place)) = found else {
                return Ok(None);
            };
            context.model.check(&source, &format!("{place}/source"))?;
            Ok(Some(source.value()))
        });
        sources.extend(context.tolerate(source, "the fallback is used"));
    }
    if !model::is_nothing(item.source) {
        let source = context.model.check(&item.source, &format!("{place}/source"));
        let source = source.map(|()| Some(item.source.value()));
        sources.extend(context.tolerate(source, "the image is left out"));
    }
    sources
}

fn read_sampler(item: &json::Texture, place: &str, model: &Model) -> Result<Sampler, Fault> {
    let Some(index) = item.sampler else {
        return Ok(Sampler::default());
    };
    let (item, place) = model.get(index, &format!("{place}/sampler"))?;
    let mut sampler = Sampler {
        wrap_u: model.valid(&item.wrap_s, &format!("{place}/wrapS"))?,
        wrap_v: model.valid(&item.wrap_t, &format!("{place}/wrapT"))?,
        ..Sampler::default()
    };
    if let Some(filter) = &item.mag_filter {
        sampler.mag = model.valid(filter, &format!("{place}/magFilter"))?;
    }
    if let Some(filter) = &item.min_filter {
        use MagFilter::{Linear, Nearest};
        let filter = model.valid(filter, &format!("{place}/minFilter"))?;
        (sampler.min, sampler.mip) = match filter {
            MinFilter::Nearest => (Nearest, None),
            MinFilter::Linear => (Linear, None),
            MinFilter::NearestMipmapNearest => (Nearest, Some(Nearest)),
            MinFilter::LinearMipmapNearest => (Linear, Some(Nearest)),
            MinFilter::NearestMipmapLinear => (Nearest, Some(Linear)),
            MinFilter::LinearMipmapLinear => (Linear, Some(Linear)),
        };
    }
    Ok(sampler)
}
