//! Which objects belong together: every root with its descendants.

use std::collections::HashMap;

use super::object::CityObject;
use crate::error::{Problem, quote};

/// The objects of a document as a forest, by their indices.
#[derive(Debug)]
pub(super) struct Hierarchy {
    parent: Vec<Option<usize>>,
    children: Vec<Vec<usize>>,
}

impl Hierarchy {
    /// Joins objects by their `parents` and `children`, either of which is enough. A group is no
    /// parent: its members are features of their own. An object with several parents goes with the
    /// first; one whose parents are all absent is a root, so that nothing that is there is lost. A
    /// child that is absent is an error, given with the index of its parent.
    pub(super) fn of(objects: &[CityObject<'_>]) -> Result<Self, (usize, Problem)> {
        let index_of: HashMap<&str, usize> = objects
            .iter()
            .enumerate()
            .map(|(i, object)| (object.id.as_ref(), i))
            .collect();
        let first_parent = |object: &CityObject<'_>| {
            let mut present = object
                .parents
                .iter()
                .filter_map(|id| index_of.get(id.as_ref()));
            present
                .find(|parent| !objects[**parent].is_group())
                .copied()
        };
        let mut parent: Vec<_> = objects.iter().map(first_parent).collect();
        for (i, object) in objects
            .iter()
            .enumerate()
            .filter(|(_, object)| !object.is_group())
        {
            for id in &object.children {
                let missing = || (i, Problem::MissingChild { child: quote(id) });
                let child = *index_of.get(id.as_ref()).ok_or_else(missing)?;
                parent[child].get_or_insert(i);
            }
        }
        let mut children = vec![Vec::new(); objects.len()];
        for (i, parent) in parent.iter().enumerate() {
            if let Some(parent) = *parent {
                children[parent].push(i);
            }
        }
        let hierarchy = Self { parent, children };
        match hierarchy.first_on_a_cycle() {
            Some(i) => Err((i, Problem::Cycle)),
            None => Ok(hierarchy),
        }
    }

    /// The roots, in the order of the document.
    pub(super) fn roots(&self) -> impl Iterator<Item = usize> {
        (0..self.parent.len()).filter(|i| self.parent[*i].is_none())
    }

    /// A root and its descendants, parents before children, in the order of the document.
    pub(super) fn family(&self, root: usize) -> Vec<usize> {
        let mut family = Vec::new();
        let mut open = vec![root];
        while let Some(object) = open.pop() {
            family.push(object);
            open.extend(self.children[object].iter().rev());
        }
        family
    }

    /// An object that no root leads to: it has itself for an ancestor, or an ancestor that has.
    fn first_on_a_cycle(&self) -> Option<usize> {
        let mut reached = vec![false; self.parent.len()];
        for object in self.roots().flat_map(|root| self.family(root)) {
            reached[object] = true;
        }
        let lost = reached.iter().position(|reached| !reached)?;
        // From a lost object the way up never ends, so after as many steps as there are objects it
        // goes round the cycle.
        (0..self.parent.len()).try_fold(lost, |object, _| self.parent[object])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn families(document: &str) -> Result<Vec<String>, (usize, Problem)> {
        let raw = serde_json::from_str(document).unwrap();
        let members = super::super::json::Members::of("objects", raw).unwrap();
        let objects: Vec<_> = members
            .into_vec()
            .into_iter()
            .map(|(id, raw)| CityObject::parse(id, raw).unwrap())
            .collect();
        let hierarchy = Hierarchy::of(&objects)?;
        let name = |i: &usize| objects[*i].id.as_ref();
        let family = |root| hierarchy.family(root).iter().map(name).collect();
        Ok(hierarchy.roots().map(family).collect())
    }

    fn expected(families: &[&str]) -> Result<Vec<String>, (usize, Problem)> {
        Ok(families.iter().map(|family| family.to_string()).collect())
    }

    #[test]
    fn children_and_grandchildren_join_their_root() {
        let document = r#"{"a":{"type":"Building","children":["b","d"]},
            "b":{"type":"BuildingPart","parents":["a"],"children":["c"]},
            "c":{"type":"BuildingInstallation","parents":["b"]},
            "d":{"type":"BuildingPart","parents":["a"]}, "e":{"type":"Road","parents":[]}}"#;
        assert_eq!(families(document), expected(&["abcd", "e"]));
    }

    #[test]
    fn either_direction_is_enough() {
        let downwards = r#"{"a":{"type":"Building","children":["b"]},"b":{"type":"BuildingPart"}}"#;
        assert_eq!(families(downwards), expected(&["ab"]));
        let upwards = r#"{"b":{"type":"BuildingPart","parents":["a"]},"a":{"type":"Building"}}"#;
        assert_eq!(families(upwards), expected(&["ab"]));
    }

    #[test]
    fn members_of_a_group_stay_roots() {
        let document = r#"{"g":{"type":"CityObjectGroup","children":["t","elsewhere"]},
            "t":{"type":"SolitaryVegetationObject","parents":["g"]}}"#;
        assert_eq!(families(document), expected(&["g", "t"]));
    }

    #[test]
    fn absent_parents_make_roots_and_absent_children_errors() {
        let orphan = r#"{"b":{"type":"BuildingPart","parents":["gone"]}}"#;
        assert_eq!(families(orphan), expected(&["b"]));
        let document = r#"{"x":{"type":"Road"},"a":{"type":"Building","children":["gone"]}}"#;
        let (object, problem) = families(document).unwrap_err();
        assert_eq!(object, 1);
        assert_eq!(problem.to_string(), "child \"gone\" is not in the document");
    }

    #[test]
    fn cycles_are_errors() {
        let itself = r#"{"a":{"type":"Building","children":["a"]}}"#;
        assert_eq!(families(itself), Err((0, Problem::Cycle)));
        let behind = r#"{"c":{"type":"BuildingPart","parents":["a"]},
            "a":{"type":"Building","parents":["b"]},"b":{"type":"BuildingPart","parents":["a"]}}"#;
        let (object, problem) = families(behind).unwrap_err();
        assert!(object > 0, "c hangs on the cycle but is not on it");
        assert_eq!(problem, Problem::Cycle);
    }
}
