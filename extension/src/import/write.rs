//! [`Writer`], rows on their way into the tables of a scene.

use super::row::Source;
use super::solid::Solid;
use crate::scene::{polygon, quoted};
use crate::types::Box3d;
use pgrx::JsonB;
use pgrx::PgOid;
use pgrx::pg_sys::BuiltinOid::{
    self, BOOLOID, FLOAT8ARRAYOID, FLOAT8OID, INT4ARRAYOID, INT4OID, INT8OID, JSONBOID,
    TEXTARRAYOID, TEXTOID,
};
use pgrx::spi::{OwnedPreparedStatement, SpiClient};

type Spi<T> = Result<T, pgrx::spi::Error>;

/// Statements that fill the tables of a scene.
pub struct Writer {
    source: String,
    next: OwnedPreparedStatement,
    feature: OwnedPreparedStatement,
    mesh: OwnedPreparedStatement,
    inner_envelope: OwnedPreparedStatement,
    solid_column: OwnedPreparedStatement,
    remark: OwnedPreparedStatement,
}

impl Writer {
    /// For a scene; `source` is what remarks say that rows came from.
    pub fn new(client: &mut SpiClient<'_>, scene: &str, source: &str) -> Spi<Self> {
        let scene = quoted(scene);
        let box3d: PgOid = PgOid::from(<Box3d as pgrx::IntoDatum>::type_oid());
        let prepare = |statement: String, types: &[PgOid]| -> Spi<OwnedPreparedStatement> {
            Ok(client.prepare_mut(statement.as_str(), types)?.keep())
        };
        let of = |types: &[BuiltinOid]| -> Vec<PgOid> {
            types.iter().map(|&oid| PgOid::BuiltIn(oid)).collect()
        };
        Ok(Self {
            source: source.to_owned(),
            next: prepare(
                format!(
                    "SELECT pg_catalog.nextval(pg_catalog.pg_get_serial_sequence('{}', 'id'))",
                    format!("{scene}.feature").replace('\'', "''")
                ),
                &[],
            )?,
            feature: prepare(
                format!(
                    "INSERT INTO {scene}.feature (id, name, class, envelope, outline, attributes) \
                     VALUES ($1, $2, $3, $4, $5::pg_catalog.polygon, $6)"
                ),
                &[
                    of(&[INT8OID, TEXTOID, TEXTOID]),
                    vec![box3d],
                    of(&[TEXTOID, JSONBOID]),
                ]
                .concat(),
            )?,
            mesh: prepare(
                format!(
                    "INSERT INTO {scene}.mesh \
                     (feature, level_of_detail, vertices, triangles, defect, repair, repair_triangles) \
                     VALUES ($1, $2, $3, $4, $5, $6, $7)"
                ),
                &of(&[
                    INT8OID,
                    FLOAT8OID,
                    FLOAT8ARRAYOID,
                    INT4ARRAYOID,
                    TEXTOID,
                    TEXTOID,
                    INT4OID,
                ]),
            )?,
            inner_envelope: prepare(
                format!(
                    "INSERT INTO {scene}.inner_envelope (feature, box, grounded) VALUES ($1, $2, $3)"
                ),
                &[of(&[INT8OID]), vec![box3d], of(&[BOOLOID])].concat(),
            )?,
            solid_column: prepare(
                format!(
                    "INSERT INTO {scene}.solid_column (feature, footprint, bottom, top, grounded) \
                     VALUES ($1, $2::pg_catalog.polygon[], $3, $4, $5)"
                ),
                &of(&[INT8OID, TEXTARRAYOID, FLOAT8OID, FLOAT8OID, BOOLOID]),
            )?,
            remark: prepare(
                format!(
                    "INSERT INTO {scene}.import_remark (source, name, class, skipped, remark) \
                     VALUES ($1, $2, $3, true, $4)"
                ),
                &of(&[TEXTOID, TEXTOID, TEXTOID, TEXTOID]),
            )?,
        })
    }

    /// Writes what became of rows; returns the numbers of those that became features.
    pub fn write(
        &self,
        client: &mut SpiClient<'_>,
        sources: &[Source],
        solids: &[Result<Solid, String>],
    ) -> Spi<Vec<i64>> {
        let mut made = Vec::with_capacity(sources.len());
        for (source, solid) in sources.iter().zip(solids) {
            match solid {
                Ok(solid) => made.extend(self.write_feature(client, source, solid)?),
                Err(why) => self.write_remark(client, source, why)?,
            }
        }
        Ok(made)
    }

    fn write_feature(
        &self,
        client: &mut SpiClient<'_>,
        source: &Source,
        solid: &Solid,
    ) -> Spi<Option<i64>> {
        let id: Option<i64> = client.update(&self.next, None, &[])?.first().get(1)?;
        let outline = solid
            .prism
            .as_ref()
            .map(|prism| polygon::corners_text(&prism.hull));
        client.update(
            &self.feature,
            None,
            &[
                id.into(),
                source.name.clone().into(),
                source.class().into(),
                Box3d(solid.envelope).into(),
                outline.into(),
                source.attributes.clone().map(JsonB).into(),
            ],
        )?;
        let mesh = &solid.solid.mesh;
        let vertices: Vec<f64> = mesh.vertices.iter().flat_map(|v| v.to_array()).collect();
        let triangles = mesh.triangles.as_flattened().iter();
        let triangles: Vec<i32> = triangles.map(|&number| number.cast_signed()).collect();
        let added = solid.solid.repair.map_or(0, |repair| repair.triangles);
        let added = i32::try_from(added).unwrap_or(i32::MAX);
        client.update(
            &self.mesh,
            None,
            &[
                id.into(),
                solid.level_of_detail.into(),
                vertices.into(),
                triangles.into(),
                solid
                    .solid
                    .hides
                    .as_ref()
                    .err()
                    .map(ToString::to_string)
                    .into(),
                solid.solid.repair.map(|repair| repair.to_string()).into(),
                added.into(),
            ],
        )?;
        if let Ok(hides) = &solid.solid.hides {
            if let Some(inner) = hides.inner {
                let bounds = Box3d(inner.bounds);
                let row = [id.into(), bounds.into(), inner.grounded.into()];
                client.update(&self.inner_envelope, None, &row)?;
            }
            for column in &hides.columns.columns {
                let row = [
                    id.into(),
                    polygon::area_text(&column.footprint).into(),
                    column.bottom.into(),
                    column.top.into(),
                    column.grounded.into(),
                ];
                client.update(&self.solid_column, None, &row)?;
            }
        }
        Ok(id)
    }

    fn write_remark(&self, client: &mut SpiClient<'_>, source: &Source, why: &str) -> Spi<()> {
        let row = [
            self.source.clone().into(),
            source.name.clone().unwrap_or_default().into(),
            source.class().into(),
            why.into(),
        ];
        client.update(&self.remark, None, &row)?;
        Ok(())
    }
}
