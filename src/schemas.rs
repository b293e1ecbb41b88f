//! The JSON Schemas in docs/schemas are those of the types that the commands print.

use std::path::Path;
use std::{env, fs};

use schemars::JsonSchema;
use serde_json::{Value, to_string_pretty};
use tautline_io::schema::of;
use tautline_papers::tables::TABLES;
use tautline_sim::trace::Summary;

use super::output::VersionedJson;
use super::{
    check, conform, hunt, judge, library, locate, minimise, prove, replay, reproduce, rescue, schemes,
    shards, show,
};

/// The command that writes the schemas anew.
const RENEW: &str = "SCHEMAS_UPDATE=always cargo test -p tautline --bin tautline schemas";

/// The schema of what [`super::output::Output::json`] prints of a type.
fn printed<T: JsonSchema>(title: &str) -> Value {
    of::<VersionedJson<'_, T>>(title).to_value()
}

/// One or the other.
#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "only its schema is of use")]
enum Either<A, B> {
    A(A),
    B(B),
}

/// Each file's name, and its schema.
fn schemas() -> Vec<(String, Value)> {
    let commands = [
        ("prove", printed::<prove::Ledger>("tautline prove")),
        ("schemes", printed::<schemes::SchemesJson>("tautline schemes")),
        ("hunt", printed::<hunt::HuntJson<'_>>("tautline hunt, and tautline merge of a hunt")),
        (
            "plan",
            printed::<shards::PlanJson<'_, Either<hunt::PlanFacts<'_>, reproduce::PlanFacts>>>(
                "tautline hunt, library or reproduce with --shards",
            ),
        ),
        ("shard", printed::<shards::ShardJson>("tautline hunt, library or reproduce with --shard")),
        ("explore", printed::<Summary<'_>>("tautline explore")),
        (
            "replay",
            printed::<Either<replay::ReplayJson<'_>, replay::RefutationJson>>(
                "tautline replay of a run of a team, or of a refutation",
            ),
        ),
        ("check", printed::<check::CheckJson>("tautline check")),
        ("conform", printed::<conform::ConformJson<'_>>("tautline conform")),
        (
            "conform-told",
            of::<conform::ToldLine<'_>>("a line that tautline conform writes to a program").to_value(),
        ),
        (
            "conform-answer",
            of::<conform::Answer>("a line that tautline conform reads from a program").to_value(),
        ),
        ("judge", printed::<judge::report::JudgeJson<'_>>("tautline judge")),
        (
            "minimise",
            printed::<Either<minimise::MinimiseJson, minimise::ShortenedJson>>(
                "tautline minimise of a run of a team, or of a run over states",
            ),
        ),
        ("library-hunt", printed::<library::hunt::HuntedJson>("tautline library with --runs")),
        ("rescue", printed::<rescue::RescueJson<'_>>("tautline rescue, and tautline replay of a rescue")),
        ("locate", printed::<Either<locate::TrialsJson<'_>, locate::FixesJson<'_>>>("tautline locate")),
        ("show", printed::<show::LayoutJson<'_>>("tautline show")),
        ("show-environments", printed::<show::EnvironmentsJson>("tautline show environments")),
        (
            "reproduce-interrupted",
            printed::<reproduce::InterruptedTable>("tautline reproduce of a table that a signal has ended"),
        ),
        ("reproduce", printed::<reproduce::List>("tautline reproduce")),
    ];
    let commands = commands.into_iter().map(|(name, schema)| (name.to_owned(), schema));
    let table = |id| format!("reproduce-{id}");
    let tables = TABLES.iter().map(|entry| (table(entry.about().id), entry.schema().to_value()));
    commands.chain(tables).collect()
}

#[test]
fn each_schema_is_that_of_the_type_that_is_printed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/schemas");
    let is_renewed = env::var_os("SCHEMAS_UPDATE").is_some_and(|value| value == "always");
    let schemas = schemas();
    for (name, schema) in &schemas {
        let (path, fresh) =
            (folder.join(format!("{name}.json")), to_string_pretty(schema).expect("JSON") + "\n");
        if is_renewed {
            fs::write(&path, &fresh).expect("a file that can be written");
        }
        // A checkout may have changed the ends of lines.
        let committed = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        assert!(
            committed == fresh,
            "what is printed is not as docs/schemas/{name}.json says. If that is meant, write it anew with\n    \
             {RENEW}\nand let schema_version grow if a field has gone or changed"
        );
    }
    assert_eq!(fs::read_dir(folder).expect("a folder").count(), schemas.len(), "a schema of nothing");
}
