//! The node types of VRML97 with their fields: ISO/IEC 14772-1, clause 6.

use super::field_type::FieldType::{self, *};

/// A type of node.
#[derive(Debug)]
pub(super) struct NodeType {
    /// Its name, as files give it.
    pub(super) name: &'static str,
    /// Its fields and exposed fields; events have no values in files.
    pub(super) fields: &'static [Field],
}

/// A field of a type of node.
#[derive(Debug)]
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) field_type: FieldType,
    /// The numbers that it holds where a node does not give it; true is 1. Strings are left out,
    /// since none of them matters here.
    pub(super) default: &'static [f64],
}

impl NodeType {
    /// The type of this name.
    pub(super) fn named(name: &str) -> Option<&'static Self> {
        let found = NODE_TYPES.binary_search_by_key(&name, |node_type| node_type.name);
        found.ok().and_then(|i| NODE_TYPES.get(i))
    }

    /// The number of the field of this name.
    pub(super) fn field(&self, name: &str) -> Option<usize> {
        self.fields.iter().position(|field| field.name == name)
    }
}

const fn node(name: &'static str, fields: &'static [Field]) -> NodeType {
    NodeType { name, fields }
}

const fn field(name: &'static str, field_type: FieldType, default: &'static [f64]) -> Field {
    Field {
        name,
        field_type,
        default,
    }
}

const NONE: &[f64] = &[];
const BOUNDING_BOX_CENTER: Field = field("bboxCenter", SFVec3f, &[0.0, 0.0, 0.0]);
const BOUNDING_BOX_SIZE: Field = field("bboxSize", SFVec3f, &[-1.0, -1.0, -1.0]);

/// All node types, sorted by name.
static NODE_TYPES: [NodeType; 54] = [
    node(
        "Anchor",
        &[
            field("children", MFNode, NONE),
            field("description", SFString, NONE),
            field("parameter", MFString, NONE),
            field("url", MFString, NONE),
            BOUNDING_BOX_CENTER,
            BOUNDING_BOX_SIZE,
        ],
    ),
    node(
        "Appearance",
        &[
            field("material", SFNode, NONE),
            field("texture", SFNode, NONE),
            field("textureTransform", SFNode, NONE),
        ],
    ),
    node(
        "AudioClip",
        &[
            field("description", SFString, NONE),
            field("loop", SFBool, &[0.0]),
            field("pitch", SFFloat, &[1.0]),
            field("startTime", SFTime, &[0.0]),
            field("stopTime", SFTime, &[0.0]),
            field("url", MFString, NONE),
        ],
    ),
    node(
        "Background",
        &[
            field("groundAngle", MFFloat, NONE),
            field("groundColor", MFColor, NONE),
            field("backUrl", MFString, NONE),
            field("bottomUrl", MFString, NONE),
            field("frontUrl", MFString, NONE),
            field("leftUrl", MFString, NONE),
            field("rightUrl", MFString, NONE),
            field("topUrl", MFString, NONE),
            field("skyAngle", MFFloat, NONE),
            field("skyColor", MFColor, &[0.0, 0.0, 0.0]),
        ],
    ),
    node(
        "Billboard",
        &[
            field("axisOfRotation", SFVec3f, &[0.0, 1.0, 0.0]),
            field("children", MFNode, NONE),
            BOUNDING_BOX_CENTER,
            BOUNDING_BOX_SIZE,
        ],
    ),
    node("Box", &[field("size", SFVec3f, &[2.0, 2.0, 2.0])]),
    node(
        "Collision",
        &[
            field("children", MFNode, NONE),
            field("collide", SFBool, &[1.0]),
            field("proxy", SFNode, NONE),
            BOUNDING_BOX_CENTER,
            BOUNDING_BOX_SIZE,
        ],
    ),
    node("Color", &[field("color", MFColor, NONE)]),
    node(
        "ColorInterpolator",
        &[
            field("key", MFFloat, NONE),
            field("keyValue", MFColor, NONE),
        ],
    ),
    node(
        "Cone",
        &[
            field("bottomRadius", SFFloat, &[1.0]),
            field("height", SFFloat, &[2.0]),
            field("side", SFBool, &[1.0]),
            field("bottom", SFBool, &[1.0]),
        ],
    ),
    node("Coordinate", &[field("point", MFVec3f, NONE)]),
    node(
        "CoordinateInterpolator",
        &[
            field("key", MFFloat, NONE),
            field("keyValue", MFVec3f, NONE),
        ],
    ),
    node(
        "Cylinder",
        &[
            field("bottom", SFBool, &[1.0]),
            field("height", SFFloat, &[2.0]),
            field("radius", SFFloat, &[1.0]),
            field("side", SFBool, &[1.0]),
            field("top", SFBool, &[1.0]),
        ],
    ),
    node(
        "CylinderSensor",
        &[
            field("autoOffset", SFBool, &[1.0]),
            field("diskAngle", SFFloat, &[0.262]),
            field("enabled", SFBool, &[1.0]),
            field("maxAngle", SFFloat, &[-1.0]),
            field("minAngle", SFFloat, &[0.0]),
            field("offset", SFFloat, &[0.0]),
        ],
    ),
    node(
        "DirectionalLight",
        &[
            field("ambientIntensity", SFFloat, &[0.0]),
            field("color", SFColor, &[1.0, 1.0, 1.0]),
            field("direction", SFVec3f, &[0.0, 0.0, -1.0]),
            field("intensity", SFFloat, &[1.0]),
            field("on", SFBool, &[1.0]),
        ],
    ),
    node(
        "ElevationGrid",
        &[
            field("color", SFNode, NONE),
            field("normal", SFNode, NONE),
            field("texCoord", SFNode, NONE),
            field("height", MFFloat, NONE),
            field("ccw", SFBool, &[1.0]),
            field("colorPerVertex", SFBool, &[1.0]),
            field("creaseAngle", SFFloat, &[0.0]),
            field("normalPerVertex", SFBool, &[1.0]),
            field("solid", SFBool, &[1.0]),
            field("xDimension", SFInt32, &[0.0]),
            field("xSpacing", SFFloat, &[1.0]),
            field("zDimension", SFInt32, &[0.0]),
            field("zSpacing", SFFloat, &[1.0]),
        ],
    ),
    node(
        "Extrusion",
        &[
            field("beginCap", SFBool, &[1.0]),
            field("ccw", SFBool, &[1.0]),
            field("convex", SFBool, &[1.0]),
            field("creaseAngle", SFFloat, &[0.0]),
            field(
                "crossSection",
                MFVec2f,
                &[1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0],
            ),
            field("endCap", SFBool, &[1.0]),
            field("orientation", MFRotation, &[0.0, 0.0, 1.0, 0.0]),
            field("scale", MFVec2f, &[1.0, 1.0]),
            field("solid", SFBool, &[1.0]),
            field("spine", MFVec3f, &[0.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
        ],
    ),
    node(
        "Fog",
        &[
            field("color", SFColor, &[1.0, 1.0, 1.0]),
            field("fogType", SFString, NONE),
            field("visibilityRange", SFFloat, &[0.0]),
        ],
    ),
    node(
        "FontStyle",
        &[
            field("family", MFString, NONE),
            field("horizontal", SFBool, &[1.0]),
            field("justify", MFString, NONE),
            field("language", SFString, NONE),
            field("leftToRight", SFBool, &[1.0]),
            field("size", SFFloat, &[1.0]),
            field("spacing", SFFloat, &[1.0]),
            field("style", SFString, NONE),
            field("topToBottom", SFBool, &[1.0]),
        ],
    ),
    node(
        "Group",
        &[
            field("children", MFNode, NONE),
            BOUNDING_BOX_CENTER,
            BOUNDING_BOX_SIZE,
        ],
    ),
    node(
        "ImageTexture",
        &[
            field("url", MFString, NONE),
            field("repeatS", SFBool, &[1.0]),
            field("repeatT", SFBool, &[1.0]),
        ],
    ),
    node(
        "IndexedFaceSet",
        &[
            field("color", SFNode, NONE),
            field("coord", SFNode, NONE),
            field("normal", SFNode, NONE),
            field("texCoord", SFNode, NONE),
            field("ccw", SFBool, &[1.0]),
            field("colorIndex", MFInt32, NONE),
            field("colorPerVertex", SFBool, &[1.0]),
            field("convex", SFBool, &[1.0]),
            field("coordIndex", MFInt32, NONE),
            field("creaseAngle", SFFloat, &[0.0]),
            field("normalIndex", MFInt32, NONE),
            field("normalPerVertex", SFBool, &[1.0]),
            field("solid", SFBool, &[1.0]),
            field("texCoordIndex", MFInt32, NONE),
        ],
    ),
    node(
        "IndexedLineSet",
        &[
            field("color", SFNode, NONE),
            field("coord", SFNode, NONE),
            field("colorIndex", MFInt32, NONE),
            field("colorPerVertex", SFBool, &[1.0]),
            field("coordIndex", MFInt32, NONE),
        ],
    ),
    node(
        "Inline",
        &[
            field("url", MFString, NONE),
            BOUNDING_BOX_CENTER,
            BOUNDING_BOX_SIZE,
        ],
    ),
    node(
        "LOD",
        &[
            field("level", MFNode, NONE),
            field("center", SFVec3f, &[0.0, 0.0, 0.0]),
            field("range", MFFloat, NONE),
        ],
    ),
    node(
        "Material",
        &[
            field("ambientIntensity", SFFloat, &[0.2]),
            field("diffuseColor", SFColor, &[0.8, 0.8, 0.8]),
            field("emissiveColor", SFColor, &[0.0, 0.0, 0.0]),
            field("shininess", SFFloat, &[0.2]),
            field("specularColor", SFColor, &[0.0, 0.0, 0.0]),
            field("transparency", SFFloat, &[0.0]),
        ],
    ),
    node(
        "MovieTexture",
        &[
            field("loop", SFBool, &[0.0]),
            field("speed", SFFloat, &[1.0]),
            field("startTime", SFTime, &[0.0]),
            field("stopTime", SFTime, &[0.0]),
            field("url", MFString, NONE),
            field("repeatS", SFBool, &[1.0]),
            field("repeatT", SFBool, &[1.0]),
        ],
    ),
    node(
        "NavigationInfo",
        &[
            field("avatarSize", MFFloat, &[0.25, 1.6, 0.75]),
            field("headlight", SFBool, &[1.0]),
            field("speed", SFFloat, &[1.0]),
            field("type", MFString, NONE),
            field("visibilityLimit", SFFloat, &[0.0]),
        ],
    ),
    node("Normal", &[field("vector", MFVec3f, NONE)]),
    node(
        "NormalInterpolator",
        &[
            field("key", MFFloat, NONE),
            field("keyValue", MFVec3f, NONE),
        ],
    ),
    node(
        "OrientationInterpolator",
        &[
            field("key", MFFloat, NONE),
            field("keyValue", MFRotation, NONE),
        ],
    ),
    node(
        "PixelTexture",
        &[
            field("image", SFImage, &[0.0, 0.0, 0.0]),
            field("repeatS", SFBool, &[1.0]),
            field("repeatT", SFBool, &[1.0]),
        ],
    ),
    node(
        "PlaneSensor",
        &[
            field("autoOffset", SFBool, &[1.0]),
            field("enabled", SFBool, &[1.0]),
            field("maxPosition", SFVec2f, &[-1.0, -1.0]),
            field("minPosition", SFVec2f, &[0.0, 0.0]),
            field("offset", SFVec3f, &[0.0, 0.0, 0.0]),
        ],
    ),
    node(
        "PointLight",
        &[
            field("ambientIntensity", SFFloat, &[0.0]),
            field("attenuation", SFVec3f, &[1.0, 0.0, 0.0]),
            field("color", SFColor, &[1.0, 1.0, 1.0]),
            field("intensity", SFFloat, &[1.0]),
            field("location", SFVec3f, &[0.0, 0.0, 0.0]),
            field("on", SFBool, &[1.0]),
            field("radius", SFFloat, &[100.0]),
        ],
    ),
    node(
        "PointSet",
        &[field("color", SFNode, NONE), field("coord", SFNode, NONE)],
    ),
    node(
        "PositionInterpolator",
        &[
            field("key", MFFloat, NONE),
            field("keyValue", MFVec3f, NONE),
        ],
    ),
    node(
        "ProximitySensor",
        &[
            field("center", SFVec3f, &[0.0, 0.0, 0.0]),
            field("size", SFVec3f, &[0.0, 0.0, 0.0]),
            field("enabled", SFBool, &[1.0]),
        ],
    ),
    node(
        "ScalarInterpolator",
        &[
            field("key", MFFloat, NONE),
            field("keyValue", MFFloat, NONE),
        ],
    ),
    node(
        "Script",
        &[
            field("url", MFString, NONE),
            field("directOutput", SFBool, &[0.0]),
            field("mustEvaluate", SFBool, &[0.0]),
        ],
    ),
    node(
        "Shape",
        &[
            field("appearance", SFNode, NONE),
            field("geometry", SFNode, NONE),
        ],
    ),
    node(
        "Sound",
        &[
            field("direction", SFVec3f, &[0.0, 0.0, 1.0]),
            field("intensity", SFFloat, &[1.0]),
            field("location", SFVec3f, &[0.0, 0.0, 0.0]),
            field("maxBack", SFFloat, &[10.0]),
            field("maxFront", SFFloat, &[10.0]),
            field("minBack", SFFloat, &[1.0]),
            field("minFront", SFFloat, &[1.0]),
            field("priority", SFFloat, &[0.0]),
            field("source", SFNode, NONE),
            field("spatialize", SFBool, &[1.0]),
        ],
    ),
    node("Sphere", &[field("radius", SFFloat, &[1.0])]),
    node(
        "SphereSensor",
        &[
            field("autoOffset", SFBool, &[1.0]),
            field("enabled", SFBool, &[1.0]),
            field("offset", SFRotation, &[0.0, 1.0, 0.0, 0.0]),
        ],
    ),
    node(
        "SpotLight",
        &[
            field("ambientIntensity", SFFloat, &[0.0]),
            field("attenuation", SFVec3f, &[1.0, 0.0, 0.0]),
            field("beamWidth", SFFloat, &[1.570796]),
            field("color", SFColor, &[1.0, 1.0, 1.0]),
            field("cutOffAngle", SFFloat, &[0.785398]),
            field("direction", SFVec3f, &[0.0, 0.0, -1.0]),
            field("intensity", SFFloat, &[1.0]),
            field("location", SFVec3f, &[0.0, 0.0, 0.0]),
            field("on", SFBool, &[1.0]),
            field("radius", SFFloat, &[100.0]),
        ],
    ),
    node(
        "Switch",
        &[
            field("choice", MFNode, NONE),
            field("whichChoice", SFInt32, &[-1.0]),
        ],
    ),
    node(
        "Text",
        &[
            field("string", MFString, NONE),
            field("fontStyle", SFNode, NONE),
            field("length", MFFloat, NONE),
            field("maxExtent", SFFloat, &[0.0]),
        ],
    ),
    node("TextureCoordinate", &[field("point", MFVec2f, NONE)]),
    node(
        "TextureTransform",
        &[
            field("center", SFVec2f, &[0.0, 0.0]),
            field("rotation", SFFloat, &[0.0]),
            field("scale", SFVec2f, &[1.0, 1.0]),
            field("translation", SFVec2f, &[0.0, 0.0]),
        ],
    ),
    node(
        "TimeSensor",
        &[
            field("cycleInterval", SFTime, &[1.0]),
            field("enabled", SFBool, &[1.0]),
            field("loop", SFBool, &[0.0]),
            field("startTime", SFTime, &[0.0]),
            field("stopTime", SFTime, &[0.0]),
        ],
    ),
    node("TouchSensor", &[field("enabled", SFBool, &[1.0])]),
    node(
        "Transform",
        &[
            field("center", SFVec3f, &[0.0, 0.0, 0.0]),
            field("children", MFNode, NONE),
            field("rotation", SFRotation, &[0.0, 0.0, 1.0, 0.0]),
            field("scale", SFVec3f, &[1.0, 1.0, 1.0]),
            field("scaleOrientation", SFRotation, &[0.0, 0.0, 1.0, 0.0]),
            field("translation", SFVec3f, &[0.0, 0.0, 0.0]),
            BOUNDING_BOX_CENTER,
            BOUNDING_BOX_SIZE,
        ],
    ),
    node(
        "Viewpoint",
        &[
            field("fieldOfView", SFFloat, &[0.785398]),
            field("jump", SFBool, &[1.0]),
            field("orientation", SFRotation, &[0.0, 0.0, 1.0, 0.0]),
            field("position", SFVec3f, &[0.0, 0.0, 10.0]),
            field("description", SFString, NONE),
        ],
    ),
    node(
        "VisibilitySensor",
        &[
            field("center", SFVec3f, &[0.0, 0.0, 0.0]),
            field("enabled", SFBool, &[1.0]),
            field("size", SFVec3f, &[0.0, 0.0, 0.0]),
        ],
    ),
    node(
        "WorldInfo",
        &[
            field("info", MFString, NONE),
            field("title", SFString, NONE),
        ],
    ),
];

#[cfg(test)]
mod tests {
    use super::super::field_type::Element;
    use super::*;

    #[test]
    fn every_type_is_found_by_its_name() {
        for node_type in &NODE_TYPES {
            let found = NodeType::named(node_type.name).map(|found| found.name);
            assert_eq!(found, Some(node_type.name));
        }
        assert!(NodeType::named("Teapot").is_none());
    }

    #[test]
    fn defaults_have_the_numbers_of_their_types() {
        for node_type in &NODE_TYPES {
            for field in node_type.fields {
                let (count, place) = (field.default.len(), (node_type.name, field.name));
                let size = match field.field_type.element() {
                    Element::Bool | Element::Integer => 1,
                    Element::Floats(size) => size,
                    Element::Image => 3,
                    Element::Text | Element::Node => 0,
                };
                match field.field_type.is_multiple() {
                    true => assert_eq!(count % size.max(1), 0, "{place:?}"),
                    false => assert_eq!(count, size, "{place:?}"),
                }
            }
        }
    }
}
