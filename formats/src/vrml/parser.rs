//! From tokens to the graph of nodes, after the grammar of ISO/IEC 14772-1, annex A.

use std::borrow::Cow;
use std::collections::HashMap;

use super::field_type::{Element, FieldType};
use super::graph::{Graph, NodeId, Value, too_deep};
use super::lexer::{Fault, Lexer, Token};
use super::node_types::NodeType;
use crate::error::{Problem, quote};
use crate::limits::{Budget, MAX_NESTING};

/// Reads the statements of a file. Routes are checked for their form only; what would need
/// another file or a node type of the file's own is refused.
pub(super) fn parse<'a>(text: &'a str, budget: &mut Budget) -> Result<Graph<'a>, Fault> {
    let mut lexer = Lexer::new(text);
    let next = lexer.next()?;
    let mut parser = Parser {
        lexer,
        next,
        graph: Graph::default(),
        names: HashMap::new(),
        budget,
        depth: 0,
    };
    while parser.next.1 != Token::End {
        if !parser.statement()? {
            let root = parser.node_statement()?;
            parser.graph.roots.push(root);
        }
    }
    Ok(parser.graph)
}

struct Parser<'a, 'b> {
    lexer: Lexer<'a>,
    /// The token to come, and where it begins.
    next: (usize, Token<'a>),
    graph: Graph<'a>,
    /// The nearest node before this place of each name.
    names: HashMap<&'a str, NodeId>,
    budget: &'b mut Budget,
    /// Nodes around this place.
    depth: u64,
}

impl<'a> Parser<'a, '_> {
    /// Takes the token to come, and gives where it begins with it.
    fn take(&mut self) -> Result<(usize, Token<'a>), Fault> {
        let next = self.lexer.next()?;
        Ok(std::mem::replace(&mut self.next, next))
    }

    fn comes(&self, word: &str) -> bool {
        self.next.1 == Token::Identifier(word)
    }

    /// Takes the token to come if it is this mark.
    fn take_if(&mut self, mark: u8) -> Result<bool, Fault> {
        let comes = self.next.1 == Token::Mark(mark);
        if comes {
            self.take()?;
        }
        Ok(comes)
    }

    fn expect(&mut self, mark: u8, what: &str, expected: &'static str) -> Result<(), Fault> {
        match self.take_if(mark)? {
            true => Ok(()),
            false => Err(self.unexpected(what, expected)),
        }
    }

    fn identifier(&mut self, what: &str) -> Result<(usize, &'a str), Fault> {
        match self.next {
            (offset, Token::Identifier(word)) => {
                self.take()?;
                Ok((offset, word))
            }
            _ => Err(self.unexpected(what, "a name")),
        }
    }

    /// The fault that the token to come is something else.
    fn unexpected(&self, what: &str, expected: &'static str) -> Fault {
        Fault::at(self.next.0)(Problem::Invalid {
            what: what.to_owned(),
            found: self.next.1.quoted(),
            expected,
        })
    }

    /// Takes a statement that is no node, if one comes.
    fn statement(&mut self) -> Result<bool, Fault> {
        if self.comes("ROUTE") {
            self.route()?;
            return Ok(true);
        }
        match ["PROTO", "EXTERNPROTO"]
            .iter()
            .find(|word| self.comes(word))
        {
            Some(word) => Err(self.unsupported((*word).to_owned())),
            None => Ok(false),
        }
    }

    fn unsupported(&self, what: String) -> Fault {
        Fault::at(self.next.0)(Problem::Unsupported { what })
    }

    /// `ROUTE a.b TO c.d`; nothing moves here, so it is passed over.
    fn route(&mut self) -> Result<(), Fault> {
        const FORM: &str = "the form: node.event TO node.event";
        self.take()?;
        self.identifier("a route")?;
        self.expect(b'.', "a route", FORM)?;
        self.identifier("a route")?;
        if !self.comes("TO") {
            return Err(self.unexpected("a route", FORM));
        }
        self.take()?;
        self.identifier("a route")?;
        self.expect(b'.', "a route", FORM)?;
        self.identifier("a route").map(|_| ())
    }

    /// A node, with `DEF` or not, or the `USE` of one.
    fn node_statement(&mut self) -> Result<NodeId, Fault> {
        if self.comes("USE") {
            self.take()?;
            return self.use_of_name();
        }
        let mut name = None;
        if self.comes("DEF") {
            self.take()?;
            name = Some(self.identifier("the name after DEF")?.1);
        }
        let id = self.node(name)?;
        if let Some(name) = name {
            self.names.insert(name, id);
        }
        Ok(id)
    }

    fn use_of_name(&mut self) -> Result<NodeId, Fault> {
        let (offset, name) = self.identifier("the name after USE")?;
        let Some(&id) = self.names.get(name) else {
            return Err(Fault::at(offset)(Problem::Invalid {
                what: "the name after USE".to_owned(),
                found: quote(name),
                expected: "one that a DEF before it gives to a complete node",
            }));
        };
        self.graph.share(id);
        Ok(id)
    }

    fn node(&mut self, name: Option<&'a str>) -> Result<NodeId, Fault> {
        let (offset, type_name) = self.identifier("the type of a node")?;
        let at = Fault::at(offset);
        let unsupported = |what| at(Problem::Unsupported { what });
        if type_name == "Inline" {
            return Err(unsupported("Inline".to_owned()));
        }
        let node_type = NodeType::named(type_name)
            .ok_or_else(|| unsupported(format!("node type {}", quote(type_name))))?;
        self.budget.objects(1).map_err(&at)?;
        self.depth += 1;
        if self.depth > MAX_NESTING {
            return Err(at(too_deep(self.depth)));
        }
        let fields = self.body(node_type)?;
        self.depth -= 1;
        self.graph.add(node_type, name, offset, fields).map_err(at)
    }

    fn body(&mut self, node_type: &'static NodeType) -> Result<Vec<(usize, Value<'a>)>, Fault> {
        self.expect(b'{', node_type.name, "\"{\" after it")?;
        let mut fields = Vec::new();
        while !self.take_if(b'}')? {
            if self.statement()? || (node_type.name == "Script" && self.declaration()?) {
                continue;
            }
            let what = || format!("a field of {}", node_type.name);
            let (offset, name) = self.identifier(&what())?;
            let fault = |problem| Err(Fault::at(offset)(problem));
            let Some(number) = node_type.field(name) else {
                return fault(Problem::Invalid {
                    what: what(),
                    found: quote(name),
                    expected: "one that vrml97 gives it",
                });
            };
            if fields.iter().any(|(i, _)| *i == number) {
                return fault(Problem::Duplicate { name: quote(name) });
            }
            fields.push((
                number,
                self.value(node_type.fields[number].field_type, name)?,
            ));
        }
        fields.shrink_to_fit();
        Ok(fields)
    }

    /// Takes a field or an event that a script declares for itself, if one comes.
    fn declaration(&mut self) -> Result<bool, Fault> {
        let is_field = self.comes("field");
        if !is_field && !self.comes("eventIn") && !self.comes("eventOut") {
            return Ok(false);
        }
        self.take()?;
        let unknown = self.unexpected("a type of field", "one of vrml97");
        let (_, type_name) = self.identifier("a type of field")?;
        let field_type = FieldType::named(type_name).ok_or(unknown)?;
        let (_, name) = self.identifier("a name of a field")?;
        if is_field {
            self.value(field_type, name)?;
        }
        Ok(true)
    }

    fn value(&mut self, field_type: FieldType, field: &str) -> Result<Value<'a>, Fault> {
        let element = field_type.element();
        let mut value = match element {
            Element::Text => Value::Texts(Vec::new()),
            Element::Node => Value::Nodes(Vec::new()),
            _ => Value::Numbers(Vec::new()),
        };
        if field_type.is_multiple() && self.take_if(b'[')? {
            while !self.take_if(b']')? {
                self.element(element, field, &mut value)?;
            }
        } else if field_type == FieldType::SFNode && self.comes("NULL") {
            self.take()?;
        } else {
            self.element(element, field, &mut value)?;
        }
        Ok(value)
    }

    /// Takes one value, and adds it to what the field holds.
    fn element(
        &mut self,
        element: Element,
        field: &str,
        value: &mut Value<'a>,
    ) -> Result<(), Fault> {
        match (element, value) {
            (Element::Node, Value::Nodes(nodes)) => nodes.push(self.node_statement()?),
            (_, Value::Texts(texts)) => texts.push(self.text(field)?),
            (Element::Bool, Value::Numbers(numbers)) => numbers.push(self.truth(field)?),
            (Element::Integer, Value::Numbers(numbers)) => numbers.push(self.integer(field)?),
            (Element::Image, Value::Numbers(numbers)) => self.image(field, numbers)?,
            (Element::Floats(count), Value::Numbers(numbers)) => {
                for _ in 0..count {
                    numbers.push(self.float(field)?);
                }
            }
            _ => return Err(self.unexpected(field, "a value of its type")),
        }
        Ok(())
    }

    fn text(&mut self, field: &str) -> Result<Cow<'a, str>, Fault> {
        if !matches!(self.next.1, Token::Text(_)) {
            return Err(self.unexpected(field, "a string"));
        }
        match self.take()?.1 {
            Token::Text(text) => Ok(text),
            _ => Ok(Cow::Borrowed("")),
        }
    }

    fn truth(&mut self, field: &str) -> Result<f64, Fault> {
        let truth = f64::from(self.comes("TRUE"));
        if truth == 0.0 && !self.comes("FALSE") {
            return Err(self.unexpected(field, "TRUE or FALSE"));
        }
        self.take()?;
        Ok(truth)
    }

    fn float(&mut self, field: &str) -> Result<f64, Fault> {
        let number = match self.next.1 {
            Token::Number(text) => text.parse().ok().filter(|number: &f64| number.is_finite()),
            _ => None,
        };
        let number = number.ok_or_else(|| self.unexpected(field, "a number"))?;
        self.take()?;
        Ok(number)
    }

    fn integer(&mut self, field: &str) -> Result<f64, Fault> {
        let number = match self.next.1 {
            Token::Number(text) => whole_number(text),
            _ => None,
        };
        let number = number.ok_or_else(|| self.unexpected(field, "a whole number of 32 bits"))?;
        self.take()?;
        Ok(number)
    }

    /// Takes an image. Only its size matters: how many pixels follow.
    fn image(&mut self, field: &str, numbers: &mut Vec<f64>) -> Result<(), Fault> {
        let [width, height, components] = [
            self.integer(field)?,
            self.integer(field)?,
            self.integer(field)?,
        ];
        numbers.extend([width, height, components]);
        let mut left = width.max(0.0) * height.max(0.0);
        while left > 0.0 {
            self.integer(field)?;
            left -= 1.0;
        }
        Ok(())
    }
}

/// The value of a whole number, decimal or hexadecimal. Pixels use all 32 bits without a sign.
fn whole_number(text: &str) -> Option<f64> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(digits) => (true, digits),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let hexadecimal = digits.strip_prefix("0x").or(digits.strip_prefix("0X"));
    let size = match hexadecimal {
        Some(digits) => u32::from_str_radix(digits, 16).ok()?,
        None => digits.parse().ok()?,
    };
    Some(if negative {
        -f64::from(size)
    } else {
        f64::from(size)
    })
}
