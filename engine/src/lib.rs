//! The geometry of occlusion: boxes and fields of view, meshes and their envelopes, the umbra of
//! one occluder, occlusion volumes along streets, the view region they are cut to, and exact lines of
//! sight.
//! Pure Rust: no PostgreSQL, no files, no clock. Metres in a right-handed frame with z up.
#![forbid(unsafe_code)]

mod box3d;
mod box_relation;
mod box_split;
mod city;
mod columns;
mod convex_pieces;
mod convex_polygon;
mod convex_prism;
mod feature_set;
mod field_of_view;
mod hilbert;
mod line_of_sight;
mod mesh;
mod outer_prism;
mod point_visibility;
mod predicates;
mod roof;
mod shadow_region;
mod solid;
mod solid_column;
mod statistics;
mod umbra;
mod view_cells;
mod view_region;
mod volumes;
mod witnesses;

pub use box_relation::{BoxRange, BoxRelation};
pub use box_split::{BoxCell, BoxSplit};
pub use box3d::Box3d;
pub use city::{BoxCity, City, CityFeature, CityLayout, generated_city, scattered_city};
pub use columns::{ColumnOptions, SolidColumns, solid_columns};
pub use convex_pieces::{ConvexPieceOptions, convex_pieces};
pub use convex_prism::ConvexPrism;
pub use feature_set::{FeatureSet, MOST_IN_SET, MalformedSet, OversizedSet, SetCollector};
pub use field_of_view::{
    Camera, DepthRange, Frustum, MatrixDefect, PlanWedge, ViewCone, ViewSector, in_range,
};
pub use hilbert::{hilbert_key, plan_key, square_key};
pub use line_of_sight::{Share, SightLine};
pub use mesh::{
    Closedness, Extrusion, GROUND_TOLERANCE, InnerEnvelope, MeshDefect, PolygonDefect,
    TriangleMesh, deviation, extruded, inner_envelope, triangulate,
};
pub use outer_prism::OuterPrism;
pub use point_visibility::{
    AzimuthRange, EYE_MARGIN, Extents, Hider, MalformedTile, PointQuery, PointSolver, PointTarget,
    Sighting, TargetShape, Tile, TileFeature, TileSource, neighbourhoods, visible_from_point,
};
pub use roof::Roof;
pub use shadow_region::ShadowRegion;
pub use solid::{Hides, Repair, Solid};
pub use solid_column::SolidColumn;
pub use statistics::BoxStatistics;
pub use umbra::{OCCLUDER_MARGIN, Occluder, ShadowCaster};
pub use view_cells::{
    CellQuery, CellScene, CellSighting, CellSolver, CellTile, CoverOptions, ViewCell, Way,
    plan_of_boxes, witness,
};
pub use view_region::{
    LocalGround, Site, Street, ViewRegion, ViewRegionOptions, covers_ground, footprint,
    is_building, open_space, streets_from_surfaces, without_footprints,
};
pub use volumes::{Block, OcclusionVolume, VolumeOptions, VolumeSolver};
pub use witnesses::{Sought, Surface, SurfaceTile, Surfaces, Witness};
