//! Input and output as all parts of the program have them: errors with their place and remedy, files that stand whole
//! or not at all, work that is kept and taken up again, lines of JSON, tables of text, pictures, and values that a
//! person types. It knows no rule and no layout, and has no terminal.

pub mod atomic_file;
pub mod checkpoint;
pub mod diagnostic;
pub mod json_lines;
pub mod named_values;
pub mod number;
pub mod schema;
pub mod shards;
pub mod svg;
pub mod text_blocks;
pub mod text_table;
pub mod value_parser;
