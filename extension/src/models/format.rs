//! [`FileFormat`], what models are handed out as.

use crate::error::Refusal;
use formats::Model;
use pgrx::PgSqlErrorCode;

/// A format that models are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// glTF 2.0 in one binary file.
    Glb,
    /// VRML97.
    Vrml97,
    /// One CityJSON document.
    CityJson,
    /// A sequence of CityJSON features.
    CityJsonSeq,
}

impl FileFormat {
    /// By its name in SQL.
    pub fn parse(name: &str) -> Result<Self, Refusal> {
        match name {
            "glb" => Ok(Self::Glb),
            "vrml97" => Ok(Self::Vrml97),
            "cityjson" => Ok(Self::CityJson),
            "cityjsonseq" => Ok(Self::CityJsonSeq),
            _ => Err(Refusal::new(
                PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
                format!("unknown model format \"{name}\""),
            )
            .hint("The format is one of glb, vrml97, cityjson, cityjsonseq.")),
        }
    }

    /// Models as one file.
    pub fn write(self, models: &[Model], srid: Option<i32>) -> Vec<u8> {
        match self {
            Self::Glb => formats::write_glb(models, srid).unwrap_or_else(|error| {
                Refusal::new(
                    PgSqlErrorCode::ERRCODE_PROGRAM_LIMIT_EXCEEDED,
                    format!("could not write the models as glb: {error}"),
                )
                .raise()
            }),
            Self::Vrml97 => formats::write_vrml(models, srid).into_bytes(),
            Self::CityJson => formats::write_city_json(models, srid).into_bytes(),
            Self::CityJsonSeq => formats::write_city_json_seq(models, srid).into_bytes(),
        }
    }
}
