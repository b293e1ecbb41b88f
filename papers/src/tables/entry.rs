//! The face of a table whose types are not known: settings from options, jobs and results as JSON, for the program and
//! for those who measure jobs elsewhere.

use std::fmt;

use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde::de::DeserializeOwned;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::{json_lines, schema};

use super::csv::csv;
use super::parameter::{Parameter, TableOption, Values};
use super::sentences::{self, Judgement};
use super::table::{Description, Observer, Table, measure};

/// A table of any types.
pub trait Entry: fmt::Debug + Sync {
    /// Its name, and what a person is told of it.
    fn about(&self) -> Description;

    /// Its options, in the order of its help, each with the texts that stand for it where it is not given.
    fn options(&self) -> Vec<(TableOption, Vec<String>)>;

    /// Whether `text` is a value of the option `name`.
    ///
    /// # Errors
    /// A hint at what to write instead.
    fn check(&self, name: &str, text: &str) -> Result<(), String>;

    /// The schema of its JSON.
    fn schema(&self) -> Schema;

    /// The table with the settings of these options and their values.
    ///
    /// # Errors
    /// A [`Diagnostic`] if a value is wrong.
    fn asked<'a>(&'a self, given: &[(String, Vec<String>)]) -> Result<Box<dyn Experiment + 'a>, Diagnostic>;

    /// The table with settings as [`Experiment::settings`] gave them.
    ///
    /// # Errors
    /// A [`Diagnostic`] if they are none, or a person could not give them.
    fn restored<'a>(&'a self, settings: &str) -> Result<Box<dyn Experiment + 'a>, Diagnostic>;
}

/// The remedy for settings, jobs and results that are none.
pub(crate) const AS_WRITTEN: &str = "take it as tautline wrote it";

/// A table with its settings.
pub trait Experiment: Sync {
    /// Its settings as JSON.
    ///
    /// # Errors
    /// A [`Diagnostic`] if they cannot be written.
    fn settings(&self) -> Result<String, Diagnostic>;

    /// Its jobs as JSON, in their order.
    ///
    /// # Errors
    /// [`Halt`] if the settings cannot be measured.
    fn jobs(&self) -> Result<Vec<String>, Halt>;

    /// The result of one of them, as JSON.
    ///
    /// # Errors
    /// [`Halt`] if it cannot be measured.
    fn measure(&self, job: &str) -> Result<String, Halt>;

    /// The table from the results of all jobs, in their order.
    ///
    /// # Errors
    /// [`Halt`] if they are not those of all jobs.
    fn merge<'a>(&'a self, results: &[String]) -> Result<Box<dyn Report + 'a>, Halt>;

    /// The table, measured here and now on all threads.
    ///
    /// # Errors
    /// [`Halt`], as the observer returned it, or if the settings cannot be measured.
    fn run<'a>(&'a self, observer: &dyn Observer) -> Result<Box<dyn Report + 'a>, Halt>;
}

/// A table that has been measured.
pub trait Report {
    /// For people.
    ///
    /// # Errors
    /// [`Halt`] if what is drawn in it cannot be found again.
    fn text(&self) -> Result<String, Halt>;

    /// For programs: one JSON object.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be written.
    fn json(&self, schema_version: u32) -> Result<String, Diagnostic>;

    /// For spreadsheets and data frames: comma-separated values, a row for each element of each of its lists.
    ///
    /// # Errors
    /// A [`Diagnostic`] as of [`Report::json`].
    fn csv(&self, schema_version: u32) -> Result<String, Diagnostic> {
        csv(&self.json(schema_version)?)
    }

    /// The picture of this name, as SVG.
    ///
    /// # Errors
    /// [`Halt`] if there is nothing to draw.
    fn picture(&self, name: &str) -> Result<String, Halt>;

    /// Whether a clause is broken that was to hold.
    fn is_broken(&self) -> bool;
}

impl<T: Table> Entry for T {
    fn about(&self) -> Description {
        Table::about(self)
    }

    fn options(&self) -> Vec<(TableOption, Vec<String>)> {
        let settings = T::Settings::default();
        let parameters = self.parameters().into_iter();
        parameters.map(|parameter| (parameter.option, (parameter.show)(&settings))).collect()
    }

    fn check(&self, name: &str, text: &str) -> Result<(), String> {
        let parameter = self.parameters().into_iter().find(|parameter| parameter.option.name == name);
        parameter.map_or(Ok(()), |parameter| (parameter.read)(&mut T::Settings::default(), &[text]))
    }

    fn schema(&self) -> Schema {
        schema::of::<Document<'_, T::Summary>>(&format!("tautline reproduce {}", Table::about(self).id))
    }

    fn asked<'a>(&'a self, given: &[(String, Vec<String>)]) -> Result<Box<dyn Experiment + 'a>, Diagnostic> {
        let mut settings = T::Settings::default();
        for parameter in self.parameters() {
            let name = parameter.option.name;
            if let Some((_, texts)) = given.iter().find(|(given, _)| given == name) {
                let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
                (parameter.read)(&mut settings, &texts)
                    .map_err(|remedy| Diagnostic::usage(format_args!("--{name} is wrong"), remedy))?;
            }
        }
        Ok(Box::new(TableExperiment { table: self, settings }))
    }

    fn restored<'a>(&'a self, settings: &str) -> Result<Box<dyn Experiment + 'a>, Diagnostic> {
        let id = Table::about(self).id;
        let restored: T::Settings = json_lines::parse(settings)
            .map_err(|(column, what)| Diagnostic::at(id, settings, column..column + 1, what, AS_WRITTEN))?;
        for Parameter { option: TableOption { name, values, .. }, show, .. } in self.parameters() {
            let texts = show(&restored);
            let mut texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            if values == Values::List {
                texts = texts.iter().flat_map(|text| text.split(',')).collect();
            }
            for text in texts {
                self.check(name, text).map_err(|hint| {
                    Diagnostic::usage(format_args!("its settings have --{name} {text}: {hint}"), AS_WRITTEN)
                })?;
            }
        }
        Ok(Box::new(TableExperiment { table: self, settings: restored }))
    }
}

struct TableExperiment<'a, T: Table> {
    table: &'a T,
    settings: T::Settings,
}

struct TableReport<'a, T: Table> {
    asked: &'a TableExperiment<'a, T>,
    merged: T::Summary,
}

/// The head of every JSON object of a table.
#[derive(JsonSchema, Serialize)]
struct Document<'a, M> {
    schema_version: u32,
    id: &'static str,
    #[serde(flatten)]
    merged: &'a M,
    /// The paper's sentences, each with its verdict.
    sentences: Vec<Judgement>,
}

fn written(value: &impl Serialize) -> Result<String, Diagnostic> {
    let unwritten = |error| Diagnostic::usage(error, "report it: this is a bug of tautline");
    serde_json::to_string(value).map_err(unwritten)
}

fn read<V: DeserializeOwned>(text: &str) -> Result<V, Diagnostic> {
    json_lines::parse(text).map_err(|(_, what)| Diagnostic::usage(what, AS_WRITTEN))
}

impl<T: Table> Experiment for TableExperiment<'_, T> {
    fn settings(&self) -> Result<String, Diagnostic> {
        written(&self.settings)
    }

    fn jobs(&self) -> Result<Vec<String>, Halt> {
        let jobs = self.table.jobs(&self.settings)?;
        Ok(jobs.iter().map(written).collect::<Result<_, _>>()?)
    }

    fn measure(&self, job: &str) -> Result<String, Halt> {
        Ok(written(&self.table.measure(&self.settings, &read(job)?, &())?)?)
    }

    fn merge<'a>(&'a self, results: &[String]) -> Result<Box<dyn Report + 'a>, Halt> {
        let jobs = self.table.jobs(&self.settings)?;
        if jobs.len() != results.len() {
            let what = format!("{} results of {} jobs", results.len(), jobs.len());
            return Err(Diagnostic::usage(what, "give the results of all jobs, in their order").into());
        }
        let results = results.iter().map(|result| read(result)).collect::<Result<Vec<_>, _>>()?;
        let merged = self.table.merge(&self.settings, jobs.into_iter().zip(results).collect())?;
        Ok(Box::new(TableReport { asked: self, merged }))
    }

    fn run<'a>(&'a self, observer: &dyn Observer) -> Result<Box<dyn Report + 'a>, Halt> {
        let merged = measure(self.table, &self.settings, observer)?;
        Ok(Box::new(TableReport { asked: self, merged }))
    }
}

impl<T: Table> Report for TableReport<'_, T> {
    fn text(&self) -> Result<String, Halt> {
        let TableExperiment { table, settings } = self.asked;
        let text = table.text(settings, &self.merged)?;
        Ok(text + &sentences::text(&table.sentences(&self.merged), Table::about(*table).why_none))
    }

    fn json(&self, schema_version: u32) -> Result<String, Diagnostic> {
        let table = self.asked.table;
        let (id, sentences) = (Table::about(table).id, table.sentences(&self.merged));
        written(&Document { schema_version, id, merged: &self.merged, sentences })
    }

    fn picture(&self, name: &str) -> Result<String, Halt> {
        let TableExperiment { table, settings } = self.asked;
        let place = Table::about(*table).picture(name)?;
        table.draw(place, settings, &self.merged)
    }

    fn is_broken(&self) -> bool {
        self.asked.table.is_broken(&self.merged)
    }
}
