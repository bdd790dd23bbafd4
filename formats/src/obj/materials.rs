//! Material libraries, after the description of the MTL format.

use std::collections::HashMap;

use super::lines::Lines;
use crate::error::Problem;
use crate::limits::{Budget, MAX_NAME_BYTES};
use crate::scene::Material;

/// The exponent of a highlight that is a shininess of 1, as VRML97 has it.
const SHARPEST_HIGHLIGHT: f64 = 128.0;

/// Longest material library.
const MAX_LIBRARY_BYTES: usize = 64 << 20;

/// A material of a library.
#[derive(Clone, Debug)]
pub(super) struct LibraryMaterial {
    pub(super) material: Material,
    /// Whether pictures belong to it.
    pub(super) has_texture: bool,
}

/// The materials of all libraries by name.
pub(super) type Library = HashMap<String, LibraryMaterial>;

/// A material of which only the name is known.
pub(super) fn unknown(name: &str) -> LibraryMaterial {
    LibraryMaterial {
        material: Material {
            name: Some(name.to_owned()),
            ..Material::default()
        },
        has_texture: false,
    }
}

/// Adds the materials of a library; what is not known of them is passed over.
pub(super) fn add_library(
    library: &mut Library,
    text: &[u8],
    budget: &mut Budget,
) -> Result<(), Problem> {
    if text.len() > MAX_LIBRARY_BYTES {
        return Err(Problem::Limit {
            what: "bytes of a material library",
            found: text.len() as u64,
            limit: MAX_LIBRARY_BYTES as u64,
        });
    }
    let mut lines = Lines::new(text);
    let mut current: Option<LibraryMaterial> = None;
    while let Some((keyword, rest)) = lines.next()? {
        if keyword == "newmtl" {
            budget.objects(1)?;
            check_name(&rest)?;
            finish(library, current.replace(unknown(&rest)));
        } else if let Some(current) = &mut current {
            set(current, &keyword, &rest);
        }
    }
    finish(library, current);
    Ok(())
}

fn finish(library: &mut Library, material: Option<LibraryMaterial>) {
    let Some(material) = material else { return };
    if let Some(name) = material.material.name.clone() {
        library.insert(name, material);
    }
}

/// Refuses names that are too long, since features carry copies.
pub(super) fn check_name(name: &str) -> Result<(), Problem> {
    match name.len() > MAX_NAME_BYTES {
        false => Ok(()),
        true => Err(Problem::Limit {
            what: "bytes of a name",
            found: name.len() as u64,
            limit: MAX_NAME_BYTES as u64,
        }),
    }
}

/// Sets one property of a material, where its value is numbers.
fn set(entry: &mut LibraryMaterial, keyword: &str, rest: &str) {
    let numbers = rest.split_whitespace().map_while(|text| text.parse().ok());
    let numbers: Vec<f64> = numbers
        .take_while(|number: &f64| number.is_finite())
        .collect();
    let share = |factor: f64| {
        numbers
            .first()
            .map(|number| (number * factor).clamp(0.0, 1.0))
    };
    let color = || match numbers[..] {
        [red, green, blue, ..] => Some([red, green, blue].map(|c| c.clamp(0.0, 1.0))),
        [grey, ..] => Some([grey.clamp(0.0, 1.0); 3]),
        [] => None,
    };
    let material = &mut entry.material;
    match keyword {
        "Kd" => replace(&mut material.diffuse, color()),
        "Ke" => replace(&mut material.emissive, color()),
        "Ks" => replace(&mut material.specular, color()),
        "Ns" => replace(&mut material.shininess, share(1.0 / SHARPEST_HIGHLIGHT)),
        "d" => replace(
            &mut material.transparency,
            share(1.0).map(|opacity| 1.0 - opacity),
        ),
        "Tr" => replace(&mut material.transparency, share(1.0)),
        "Pm" => material.metallic = share(1.0),
        "Pr" => material.roughness = share(1.0),
        _ => entry.has_texture |= keyword.starts_with("map_"),
    }
}

/// Puts a value in place of another, if there is one.
fn replace<T>(place: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *place = value;
    }
}
