//! The node types of VRML97 with their fields: ISO/IEC 14772-1, clause 6.

use std::sync::LazyLock;

use super::field_type::FieldType;

/// A type of node.
#[derive(Debug)]
pub(super) struct NodeType {
    /// Its name, as files give it.
    pub(super) name: &'static str,
    /// Its fields and exposed fields; events have no values in files.
    pub(super) fields: Vec<Field>,
}

/// A field of a type of node.
#[derive(Debug)]
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) field_type: FieldType,
    /// The numbers that it holds where a node does not give it.
    pub(super) default: Vec<f64>,
}

impl NodeType {
    /// The type of this name.
    pub(super) fn named(name: &str) -> Option<&'static Self> {
        let types = &*NODE_TYPES;
        let found = types.binary_search_by_key(&name, |node_type| node_type.name);
        found.ok().and_then(|i| types.get(i))
    }

    /// The number of the field of this name.
    pub(super) fn field(&self, name: &str) -> Option<usize> {
        self.fields.iter().position(|field| field.name == name)
    }
}

/// The table below, taken apart.
static NODE_TYPES: LazyLock<Vec<NodeType>> = LazyLock::new(|| {
    let types = TABLE.iter().map(|(name, fields)| NodeType {
        name,
        fields: fields.split(';').filter_map(field).collect(),
    });
    types.collect()
});

fn field(text: &'static str) -> Option<Field> {
    let mut words = text.split_whitespace();
    Some(Field {
        field_type: FieldType::named(words.next()?)?,
        name: words.next()?,
        default: words.map_while(|number| number.parse().ok()).collect(),
    })
}

/// All node types, sorted by name. Of each field the type, the name and the numbers of the default,
/// true as 1; strings are left out, since no default that is a string matters here.
const TABLE: [(&str, &str); 54] = [
    (
        "Anchor",
        "MFNode children; SFString description; MFString parameter; MFString url; \
         SFVec3f bboxCenter 0 0 0; SFVec3f bboxSize -1 -1 -1",
    ),
    (
        "Appearance",
        "SFNode material; SFNode texture; SFNode textureTransform",
    ),
    (
        "AudioClip",
        "SFString description; SFBool loop 0; SFFloat pitch 1; SFTime startTime 0; \
         SFTime stopTime 0; MFString url",
    ),
    (
        "Background",
        "MFFloat groundAngle; MFColor groundColor; MFString backUrl; MFString bottomUrl; \
         MFString frontUrl; MFString leftUrl; MFString rightUrl; MFString topUrl; \
         MFFloat skyAngle; MFColor skyColor 0 0 0",
    ),
    (
        "Billboard",
        "SFVec3f axisOfRotation 0 1 0; MFNode children; SFVec3f bboxCenter 0 0 0; \
         SFVec3f bboxSize -1 -1 -1",
    ),
    ("Box", "SFVec3f size 2 2 2"),
    (
        "Collision",
        "MFNode children; SFBool collide 1; SFNode proxy; SFVec3f bboxCenter 0 0 0; \
         SFVec3f bboxSize -1 -1 -1",
    ),
    ("Color", "MFColor color"),
    ("ColorInterpolator", "MFFloat key; MFColor keyValue"),
    (
        "Cone",
        "SFFloat bottomRadius 1; SFFloat height 2; SFBool side 1; SFBool bottom 1",
    ),
    ("Coordinate", "MFVec3f point"),
    ("CoordinateInterpolator", "MFFloat key; MFVec3f keyValue"),
    (
        "Cylinder",
        "SFBool bottom 1; SFFloat height 2; SFFloat radius 1; SFBool side 1; SFBool top 1",
    ),
    (
        "CylinderSensor",
        "SFBool autoOffset 1; SFFloat diskAngle 0.262; SFBool enabled 1; \
         SFFloat maxAngle -1; SFFloat minAngle 0; SFFloat offset 0",
    ),
    (
        "DirectionalLight",
        "SFFloat ambientIntensity 0; SFColor color 1 1 1; SFVec3f direction 0 0 -1; \
         SFFloat intensity 1; SFBool on 1",
    ),
    (
        "ElevationGrid",
        "SFNode color; SFNode normal; SFNode texCoord; MFFloat height; SFBool ccw 1; \
         SFBool colorPerVertex 1; SFFloat creaseAngle 0; SFBool normalPerVertex 1; \
         SFBool solid 1; SFInt32 xDimension 0; SFFloat xSpacing 1; SFInt32 zDimension 0; \
         SFFloat zSpacing 1",
    ),
    (
        "Extrusion",
        "SFBool beginCap 1; SFBool ccw 1; SFBool convex 1; SFFloat creaseAngle 0; \
         MFVec2f crossSection 1 1 1 -1 -1 -1 -1 1 1 1; SFBool endCap 1; \
         MFRotation orientation 0 0 1 0; MFVec2f scale 1 1; SFBool solid 1; \
         MFVec3f spine 0 0 0 0 1 0",
    ),
    (
        "Fog",
        "SFColor color 1 1 1; SFString fogType; SFFloat visibilityRange 0",
    ),
    (
        "FontStyle",
        "MFString family; SFBool horizontal 1; MFString justify; SFString language; \
         SFBool leftToRight 1; SFFloat size 1; SFFloat spacing 1; SFString style; \
         SFBool topToBottom 1",
    ),
    (
        "Group",
        "MFNode children; SFVec3f bboxCenter 0 0 0; SFVec3f bboxSize -1 -1 -1",
    ),
    (
        "ImageTexture",
        "MFString url; SFBool repeatS 1; SFBool repeatT 1",
    ),
    (
        "IndexedFaceSet",
        "SFNode color; SFNode coord; SFNode normal; SFNode texCoord; SFBool ccw 1; \
         MFInt32 colorIndex; SFBool colorPerVertex 1; SFBool convex 1; MFInt32 coordIndex; \
         SFFloat creaseAngle 0; MFInt32 normalIndex; SFBool normalPerVertex 1; \
         SFBool solid 1; MFInt32 texCoordIndex",
    ),
    (
        "IndexedLineSet",
        "SFNode color; SFNode coord; MFInt32 colorIndex; SFBool colorPerVertex 1; \
         MFInt32 coordIndex",
    ),
    (
        "Inline",
        "MFString url; SFVec3f bboxCenter 0 0 0; SFVec3f bboxSize -1 -1 -1",
    ),
    ("LOD", "MFNode level; SFVec3f center 0 0 0; MFFloat range"),
    (
        "Material",
        "SFFloat ambientIntensity 0.2; SFColor diffuseColor 0.8 0.8 0.8; \
         SFColor emissiveColor 0 0 0; SFFloat shininess 0.2; SFColor specularColor 0 0 0; \
         SFFloat transparency 0",
    ),
    (
        "MovieTexture",
        "SFBool loop 0; SFFloat speed 1; SFTime startTime 0; SFTime stopTime 0; \
         MFString url; SFBool repeatS 1; SFBool repeatT 1",
    ),
    (
        "NavigationInfo",
        "MFFloat avatarSize 0.25 1.6 0.75; SFBool headlight 1; SFFloat speed 1; \
         MFString type; SFFloat visibilityLimit 0",
    ),
    ("Normal", "MFVec3f vector"),
    ("NormalInterpolator", "MFFloat key; MFVec3f keyValue"),
    (
        "OrientationInterpolator",
        "MFFloat key; MFRotation keyValue",
    ),
    (
        "PixelTexture",
        "SFImage image 0 0 0; SFBool repeatS 1; SFBool repeatT 1",
    ),
    (
        "PlaneSensor",
        "SFBool autoOffset 1; SFBool enabled 1; SFVec2f maxPosition -1 -1; \
         SFVec2f minPosition 0 0; SFVec3f offset 0 0 0",
    ),
    (
        "PointLight",
        "SFFloat ambientIntensity 0; SFVec3f attenuation 1 0 0; SFColor color 1 1 1; \
         SFFloat intensity 1; SFVec3f location 0 0 0; SFBool on 1; SFFloat radius 100",
    ),
    ("PointSet", "SFNode color; SFNode coord"),
    ("PositionInterpolator", "MFFloat key; MFVec3f keyValue"),
    (
        "ProximitySensor",
        "SFVec3f center 0 0 0; SFVec3f size 0 0 0; SFBool enabled 1",
    ),
    ("ScalarInterpolator", "MFFloat key; MFFloat keyValue"),
    (
        "Script",
        "MFString url; SFBool directOutput 0; SFBool mustEvaluate 0",
    ),
    ("Shape", "SFNode appearance; SFNode geometry"),
    (
        "Sound",
        "SFVec3f direction 0 0 1; SFFloat intensity 1; SFVec3f location 0 0 0; \
         SFFloat maxBack 10; SFFloat maxFront 10; SFFloat minBack 1; SFFloat minFront 1; \
         SFFloat priority 0; SFNode source; SFBool spatialize 1",
    ),
    ("Sphere", "SFFloat radius 1"),
    (
        "SphereSensor",
        "SFBool autoOffset 1; SFBool enabled 1; SFRotation offset 0 1 0 0",
    ),
    (
        "SpotLight",
        "SFFloat ambientIntensity 0; SFVec3f attenuation 1 0 0; SFFloat beamWidth 1.570796; \
         SFColor color 1 1 1; SFFloat cutOffAngle 0.785398; SFVec3f direction 0 0 -1; \
         SFFloat intensity 1; SFVec3f location 0 0 0; SFBool on 1; SFFloat radius 100",
    ),
    ("Switch", "MFNode choice; SFInt32 whichChoice -1"),
    (
        "Text",
        "MFString string; SFNode fontStyle; MFFloat length; SFFloat maxExtent 0",
    ),
    ("TextureCoordinate", "MFVec2f point"),
    (
        "TextureTransform",
        "SFVec2f center 0 0; SFFloat rotation 0; SFVec2f scale 1 1; SFVec2f translation 0 0",
    ),
    (
        "TimeSensor",
        "SFTime cycleInterval 1; SFBool enabled 1; SFBool loop 0; SFTime startTime 0; \
         SFTime stopTime 0",
    ),
    ("TouchSensor", "SFBool enabled 1"),
    (
        "Transform",
        "SFVec3f center 0 0 0; MFNode children; SFRotation rotation 0 0 1 0; \
         SFVec3f scale 1 1 1; SFRotation scaleOrientation 0 0 1 0; \
         SFVec3f translation 0 0 0; SFVec3f bboxCenter 0 0 0; SFVec3f bboxSize -1 -1 -1",
    ),
    (
        "Viewpoint",
        "SFFloat fieldOfView 0.785398; SFBool jump 1; SFRotation orientation 0 0 1 0; \
         SFVec3f position 0 0 10; SFString description",
    ),
    (
        "VisibilitySensor",
        "SFVec3f center 0 0 0; SFBool enabled 1; SFVec3f size 0 0 0",
    ),
    ("WorldInfo", "MFString info; SFString title"),
];

#[cfg(test)]
mod tests {
    use super::super::field_type::Element;
    use super::*;

    #[test]
    fn every_type_is_found_by_its_name() {
        for node_type in &*NODE_TYPES {
            let found = NodeType::named(node_type.name).map(|found| found.name);
            assert_eq!(found, Some(node_type.name));
        }
        assert!(NodeType::named("Teapot").is_none());
        let written = TABLE.iter().map(|(_, fields)| fields.split(';').count());
        let taken = NODE_TYPES.iter().map(|node_type| node_type.fields.len());
        assert!(written.eq(taken));
    }

    #[test]
    fn defaults_have_the_numbers_of_their_types() {
        for node_type in &*NODE_TYPES {
            for field in &node_type.fields {
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
