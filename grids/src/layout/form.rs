//! The forms in which generators of layouts are described.

/// How a generator is described.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Form {
    name: &'static str,
    /// The description with its parts named.
    pub pattern: &'static str,
    /// A description that is right.
    pub example: &'static str,
}

/// All generators.
pub const FORMS: [Form; 6] = [
    Form { name: "open", pattern: "open:WIDTHxHEIGHT", example: "open:15x15" },
    Form { name: "walls", pattern: "walls:WIDTHxHEIGHT:PROBABILITY", example: "walls:15x15:0.1" },
    Form { name: "rooms-a", pattern: "rooms-a", example: "rooms-a" },
    Form { name: "rooms-b", pattern: "rooms-b", example: "rooms-b" },
    Form { name: "office", pattern: "office:WIDTHxHEIGHT:ACROSSxDOWN", example: "office:30x30:4x4" },
    Form { name: "cells", pattern: "cells:WIDTHxHEIGHT:PROBABILITY", example: "cells:32x32:0.2" },
];

impl Form {
    /// The generator that the part of `description` before the first colon names.
    pub(super) fn of(description: &str) -> Option<Self> {
        let name = description.split_once(':').map_or(description, |(name, _)| name);
        FORMS.into_iter().find(|form| form.name == name)
    }
}

/// A description of each generator.
pub(super) fn examples() -> String {
    FORMS.map(|form| form.example).join(", ")
}
