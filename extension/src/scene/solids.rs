//! [`Solids`], what hides in the features of a scene.

use super::{failed, polygon};
use crate::types::Box3d;
use engine::{ConvexPieceOptions, ConvexPrism, Occluder, SolidColumn, convex_pieces};
use pgrx::Spi;
use pgrx::datum::DatumWithOid;
use rayon::prelude::*;
use std::collections::HashMap;

/// The solid prisms of each feature that has some: its columns, and the box inside it.
#[derive(Clone, Default, PartialEq)]
pub struct Solids(HashMap<i64, Vec<SolidColumn>>);

impl Solids {
    /// Those that the rows of a scene's tables hold for which a condition with these arguments is
    /// true. The scene's name is quoted.
    pub fn read(scene: &str, condition: &str, arguments: &[DatumWithOid]) -> Self {
        let mut solids = Self::default();
        let columns = format!(
            "SELECT feature, footprint::pg_catalog.text[], bottom, top, grounded \
             FROM {scene}.solid_column WHERE {condition}"
        );
        // A read-only query may not lock rows.
        let read = Spi::connect_mut(|client| {
            for row in client.update(&columns, None, arguments)? {
                let footprint: Option<Vec<Option<String>>> = row.get(2)?;
                let rings: Option<Vec<String>> =
                    footprint.unwrap_or_default().into_iter().collect();
                let footprint = rings.and_then(|rings| polygon::area(&rings));
                let (feature, bottom, top, grounded) =
                    (row.get(1)?, row.get(3)?, row.get(4)?, row.get(5)?);
                solids.add(feature, footprint, bottom, top, grounded);
            }
            let boxes = format!(
                "SELECT feature, box, grounded FROM {scene}.inner_envelope WHERE {condition}"
            );
            for row in client.update(&boxes, None, arguments)? {
                let bounds = row.get::<Box3d>(2)?.map(|bounds| bounds.0);
                let footprint = bounds.map(|bounds| polygon::rectangle(&bounds));
                let (bottom, top) = (bounds.map(|b| b.min.z), bounds.map(|b| b.max.z));
                solids.add(row.get(1)?, footprint, bottom, top, row.get(3)?);
            }
            Ok::<_, pgrx::spi::Error>(())
        });
        read.unwrap_or_else(|error| failed(&error));
        solids
    }

    /// How many features have some.
    pub fn features(&self) -> usize {
        self.0.len()
    }

    /// What a feature has, its order left open.
    pub fn same(&self, other: &Self, feature: i64) -> bool {
        let sorted = |solids: &Self| {
            let mut columns = solids.0.get(&feature).cloned().unwrap_or_default();
            columns.sort_by(|a, b| {
                (a.bottom.total_cmp(&b.bottom))
                    .then(a.top.total_cmp(&b.top))
                    .then_with(|| format!("{:?}", a.footprint).cmp(&format!("{:?}", b.footprint)))
            });
            columns
        };
        sorted(self) == sorted(other)
    }

    /// Convex pieces of all of them; on the threads of the pool that runs it.
    pub fn occluders(&self) -> Vec<Occluder> {
        let mut features: Vec<(&i64, &Vec<SolidColumn>)> = self.0.iter().collect();
        features.sort_by_key(|(feature, _)| **feature);
        let options = ConvexPieceOptions::default();
        let occluder = |feature: i64| move |prism: ConvexPrism| Occluder { feature, prism };
        features
            .into_par_iter()
            .flat_map_iter(|(&feature, columns)| {
                convex_pieces(columns, &options)
                    .into_iter()
                    .map(occluder(feature))
            })
            .collect()
    }

    fn add(
        &mut self,
        feature: Option<i64>,
        footprint: Option<geo::Polygon<f64>>,
        bottom: Option<f64>,
        top: Option<f64>,
        grounded: Option<bool>,
    ) {
        let column = footprint.zip(bottom.zip(top)).zip(grounded);
        if let Some((feature, ((footprint, (bottom, top)), grounded))) = feature.zip(column) {
            self.0.entry(feature).or_default().push(SolidColumn {
                footprint,
                bottom,
                top,
                grounded,
            });
        }
    }
}
