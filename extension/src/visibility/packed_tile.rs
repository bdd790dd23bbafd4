//! [`PackedTile`], a tile as the table `tile` holds it: the classes of its features, then the tile.

use super::base::BaseFeature;
use crate::error::Refusal;
use engine::Tile;
use pgrx::PgSqlErrorCode;
use std::collections::HashMap;
use std::rc::Rc;

/// A tile with the classes of its features.
#[derive(Debug)]
pub struct PackedTile {
    pub tile: Tile,
    classes: Vec<String>,
    /// Of each feature in the tile, the position of its class.
    class_of: Vec<u32>,
    /// Bytes that it takes in memory, or a few more.
    size: usize,
}

impl PackedTile {
    /// The tile of some features.
    pub fn new(features: Vec<BaseFeature>) -> Self {
        let (features, names): (Vec<_>, Vec<_>) = features
            .into_iter()
            .map(|base| (base.feature, base.class))
            .unzip();
        let ids = features.iter().map(|feature| feature.id);
        let name_of = ids.zip(names.iter().map(String::as_str)).collect();
        Self::with_classes(Tile::new(&features), &name_of)
    }

    /// The tile of features that others hold, each once: given by tile and position.
    pub fn gathered(picks: &[(Rc<Self>, usize)]) -> Self {
        let mut name_of = HashMap::with_capacity(picks.len());
        let mut spots = Vec::with_capacity(picks.len());
        for (packed, position) in picks {
            let (id, _) = packed.tile.feature(*position);
            name_of.insert(id, packed.class(*position));
            spots.push((&packed.tile, *position));
        }
        Self::with_classes(Tile::gathered(&spots), &name_of)
    }

    /// A tile and the classes of its features, by their ids.
    fn with_classes(tile: Tile, name_of: &HashMap<i64, &str>) -> Self {
        let mut names: Vec<&str> = name_of.values().copied().collect();
        names.sort_unstable();
        names.dedup();
        let class_of = (0..tile.len()).map(|position| {
            let name = name_of[&tile.feature(position).0];
            let class = names.partition_point(|&class| class < name);
            u32::try_from(class).unwrap_or(u32::MAX)
        });
        let class_of = class_of.collect();
        let classes = names.into_iter().map(str::to_owned).collect();
        Self::with_size(tile, classes, class_of)
    }

    fn with_size(tile: Tile, classes: Vec<String>, class_of: Vec<u32>) -> Self {
        let names: usize = classes
            .iter()
            .map(|class| class.len() + size_of::<String>())
            .sum();
        let size = tile.size() + names + 4 * class_of.len() + size_of::<Self>();
        Self {
            tile,
            classes,
            class_of,
            size,
        }
    }

    /// The class of the feature at a position.
    pub fn class(&self, position: usize) -> &str {
        &self.classes[self.class_of[position] as usize]
    }

    /// Bytes that it takes in memory.
    pub fn size(&self) -> usize {
        self.size
    }

    /// As the table holds it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.size);
        let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes();
        bytes.extend(number(self.classes.len()));
        for class in &self.classes {
            bytes.extend(number(class.len()));
            bytes.extend(class.as_bytes());
        }
        bytes.extend(number(self.class_of.len()));
        bytes.extend(self.class_of.iter().flat_map(|class| class.to_le_bytes()));
        bytes.extend(self.tile.to_bytes());
        bytes
    }

    /// From what the table holds, whoever wrote it.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Refusal> {
        let mut left = bytes;
        let head = Self::head(&mut left);
        let (classes, class_of) = head.ok_or_else(|| malformed("its classes are cut off"))?;
        let tile = Tile::from_bytes(left).map_err(|error| malformed(&error.to_string()))?;
        let are_known = class_of
            .iter()
            .all(|&class| (class as usize) < classes.len());
        if class_of.len() != tile.len() || !are_known {
            return Err(malformed("its classes are not those of its features"));
        }
        Ok(Self::with_size(tile, classes, class_of))
    }

    fn head(bytes: &mut &[u8]) -> Option<(Vec<String>, Vec<u32>)> {
        let mut classes = Vec::new();
        for _ in 0..number(bytes)? {
            let length = number(bytes)? as usize;
            let class = bytes.split_off(..length)?;
            classes.push(String::from_utf8(class.to_vec()).ok()?);
        }
        let mut class_of = Vec::new();
        for _ in 0..number(bytes)? {
            class_of.push(number(bytes)?);
        }
        Some((classes, class_of))
    }
}

fn number(bytes: &mut &[u8]) -> Option<u32> {
    let number = bytes.split_off(..4)?;
    Some(u32::from_le_bytes(number.try_into().ok()?))
}

fn malformed(why: &str) -> Refusal {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_DATA_CORRUPTED,
        "a packed tile is malformed",
    )
    .detail(format!("{}{}.", why[..1].to_uppercase(), &why[1..]))
    .hint("TRUNCATE the table tile of the scene, then call occlusion.pack_tiles.")
}
