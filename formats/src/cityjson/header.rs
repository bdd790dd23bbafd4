//! What a document says once for all its objects: version, transform, metadata, templates.

use serde_json::value::RawValue;

use super::appearance::Appearance;
use super::budget::Budget;
use super::json::{Members, invalid, string};
use super::templates::Templates;
use super::vertices::Transform;
use crate::error::Problem;
use crate::scene::SceneDescription;

/// The members of a document beside its objects and their vertices.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) transform: Transform,
    pub(super) templates: Templates,
    /// The appearance of the templates, and of all objects of a document.
    pub(super) appearance: Appearance,
    /// What every batch says of the file.
    pub(super) description: SceneDescription,
}

impl Header {
    /// Reads the members of a whole document or of the first line of a sequence.
    pub(super) fn parse(members: &Members<'_>, budget: &mut Budget<'_>) -> Result<Self, Problem> {
        let version = members.require("version", "version")?;
        check_version(version)?;
        let appearance = members.get("appearance").map(Appearance::parse);
        let appearance = appearance.unwrap_or_default();
        let templates = match members.get("geometry-templates") {
            Some(raw) => Templates::parse(raw, &appearance, budget)?,
            None => Templates::default(),
        };
        let metadata = match members.get("metadata") {
            Some(raw) => Members::of("metadata", raw)?,
            None => Members::default(),
        };
        let reference_system = metadata.get("referenceSystem");
        Ok(Self {
            transform: Transform::parse(members.require("transform", "transform")?)?,
            templates,
            appearance,
            description: SceneDescription {
                srid: reference_system.map(srid).transpose()?.flatten(),
                title: metadata.get("title").and_then(text),
                attribution: attribution(&metadata),
                ..SceneDescription::default()
            },
        })
    }
}

fn check_version(raw: &RawValue) -> Result<(), Problem> {
    match string("version", raw)?.as_ref() {
        "1.1" | "2.0" => Ok(()),
        _ => Err(Problem::Version {
            found: crate::error::shorten(raw.get()),
        }),
    }
}

/// The EPSG code at the end of `…/def/crs/EPSG/0/7415` or `urn:ogc:def:crs:EPSG::7415`; none for
/// another authority's system.
fn srid(raw: &RawValue) -> Result<Option<i32>, Problem> {
    let system = string("metadata.referenceSystem", raw)?;
    let parts: Vec<_> = system.split(['/', ':']).collect();
    if !parts.iter().any(|part| part.eq_ignore_ascii_case("EPSG")) {
        return Ok(None);
    }
    let code = parts
        .last()
        .and_then(|code| code.parse().ok())
        .filter(|code| *code > 0);
    let wrong = || invalid("metadata.referenceSystem", raw, "an epsg code at the end");
    code.map(Some).ok_or_else(wrong)
}

/// Whom to credit: the organization or the contact, and the web address. Metadata that is not as
/// the format has it costs the credit, not the import.
fn attribution(metadata: &Members<'_>) -> Option<String> {
    let contact = Members::of("pointOfContact", metadata.get("pointOfContact")?).ok()?;
    let member = |name| contact.get(name).and_then(text);
    let parts = [
        member("organization").or_else(|| member("contactName")),
        member("website"),
    ];
    let parts: Vec<_> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

fn text(raw: &RawValue) -> Option<String> {
    string("text", raw).ok().map(|text| text.into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quoted<T>(text: &str, read: impl Fn(&RawValue) -> T) -> T {
        read(serde_json::from_str::<&RawValue>(&format!("\"{text}\"")).unwrap())
    }

    #[test]
    fn srid_is_the_code_at_the_end() {
        for system in [
            "https://www.opengis.net/def/crs/EPSG/0/7415",
            "http://www.opengis.net/def/crs/EPSG/0/7415",
            "urn:ogc:def:crs:EPSG::7415",
            "EPSG:7415",
        ] {
            assert_eq!(quoted(system, srid), Ok(Some(7415)), "{system}");
        }
        assert_eq!(
            quoted("https://www.opengis.net/def/crs/OGC/0/CRS84", srid),
            Ok(None)
        );
        for wrong in ["EPSG:", "EPSG:-1", "EPSG:99999999999"] {
            let message = quoted(wrong, srid).unwrap_err().to_string();
            let expected = "expected an epsg code at the end";
            assert_eq!(
                message,
                format!("metadata.referenceSystem is \"{wrong}\", {expected}")
            );
        }
    }

    #[test]
    fn only_versions_1_1_and_2_0_are_read() {
        assert_eq!(quoted("1.1", check_version), Ok(()));
        assert_eq!(quoted("2.0", check_version), Ok(()));
        assert_eq!(
            quoted("1.0", check_version).unwrap_err().to_string(),
            "cityjson version \"1.0\" is not supported, expected \"1.1\" or \"2.0\""
        );
    }

    #[test]
    fn credit_goes_to_the_organization_or_the_contact() {
        let credit = |text: &str| {
            let raw = serde_json::from_str(text).unwrap();
            attribution(&Members::of("metadata", raw).unwrap())
        };
        let both = r#"{"pointOfContact":{"contactName":"A","website":"https://a.example"}}"#;
        assert_eq!(credit(both).as_deref(), Some("A, https://a.example"));
        let organization = r#"{"pointOfContact":{"contactName":"A","organization":"B"}}"#;
        assert_eq!(credit(organization).as_deref(), Some("B"));
        assert_eq!(credit(r#"{"pointOfContact":[7]}"#), None);
        assert_eq!(credit("{}"), None);
    }
}
