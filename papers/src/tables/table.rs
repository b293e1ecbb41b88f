//! A table that can be measured: what it is asked, and what its files share.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use tautline_proofs::engine::threads;
use tautline_proofs::engine::tree::Progress;

use super::parameter::{Parameter, Settings};
use super::sentences::Judgement;
use tautline_field::radio::Problem;
use tautline_grids::layout::{Generator, Layout};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::ground::Cell;
use tautline_sim::explore::Setup;

/// A table or a figure that can be measured. Its results depend on its settings alone, and not on who measures which of
/// its jobs, or in which order.
pub trait Table: fmt::Debug + Sync + 'static {
    /// The table's settings.
    type Settings: Settings;
    /// A part of the work, independent of all others.
    type Job: Serialize + DeserializeOwned + Send + Sync;
    /// The result of a job.
    type Sample: Serialize + DeserializeOwned + Send;
    /// The whole table. Its members follow `schema_version` and `id` in the JSON.
    type Summary: JsonSchema + Serialize;

    /// Its name, and what a person is told of it.
    fn about(&self) -> Description;

    /// Its settings, as a person gives them, in the order in which a help text has them.
    fn parameters(&self) -> Vec<Parameter<Self::Settings>> {
        Self::Settings::parameters()
    }

    /// How its jobs share the threads.
    fn threads(&self) -> Threads {
        Threads::OneEach
    }

    /// All jobs. Their order is that of the results which are merged.
    ///
    /// # Errors
    /// [`Halt`] if the settings cannot be measured: the same each time, whichever job would meet it first.
    fn jobs(&self, settings: &Self::Settings) -> Result<Vec<Self::Job>, Halt>;

    /// How many parts a job has, of those that a person sees counted.
    fn parts(&self, _job: &Self::Job) -> u64 {
        1
    }

    /// Measures one job. The observer hears of what goes on within it, not of its end.
    ///
    /// # Errors
    /// [`Halt`], as the observer returned it, or if the job cannot be measured.
    fn measure(
        &self,
        settings: &Self::Settings,
        job: &Self::Job,
        observer: &dyn Observer,
    ) -> Result<Self::Sample, Halt>;

    /// The table from the results of all jobs, in their order.
    ///
    /// # Errors
    /// [`Halt`] if there is none.
    fn merge(&self, settings: &Self::Settings, results: Results<Self>) -> Result<Self::Summary, Halt>;

    /// The table for people. Ends with a newline.
    ///
    /// # Errors
    /// [`Halt`] if what is drawn in it cannot be found again.
    fn text(&self, settings: &Self::Settings, merged: &Self::Summary) -> Result<String, Halt>;

    /// The sentences of a paper that are compared with it, each with its verdict; they follow the text and, as
    /// `sentences`, the members of the JSON. Where there is none, [`Description::why_none`] says why.
    fn sentences(&self, _merged: &Self::Summary) -> Vec<Judgement> {
        Vec::new()
    }

    /// The picture with this place among those that [`Description`] names, as SVG.
    ///
    /// # Errors
    /// [`Halt`] if there is nothing to draw.
    fn draw(
        &self,
        _picture: usize,
        _settings: &Self::Settings,
        _merged: &Self::Summary,
    ) -> Result<String, Halt> {
        Ok(String::new())
    }

    /// Whether a clause is broken that was to hold.
    fn is_broken(&self, _merged: &Self::Summary) -> bool {
        false
    }
}

/// A table's name, and what a person is told of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Description {
    /// Its name.
    pub id: &'static str,
    /// A line about it, for the list of all tables.
    pub shows: &'static str,
    /// The first line of its help.
    pub help: &'static str,
    /// More for its help; may be empty.
    pub more: &'static str,
    /// Ids with options that are worth a try.
    pub examples: &'static [&'static str],
    /// The work in progress while it is measured.
    pub doing: &'static str,
    /// How long it takes by its own settings on two cores, roughly.
    pub takes: &'static str,
    /// Why no sentence of a paper is compared with it, if none is.
    pub why_none: &'static str,
    /// The names of its pictures, and what they show, as a help text has it.
    pub pictures: &'static [(&'static str, &'static str)],
}

impl Description {
    /// Nothing, which a table fills in.
    pub(super) const NOTHING: Self = Self {
        id: "",
        shows: "",
        help: "",
        more: "",
        examples: &[],
        doing: "",
        takes: "",
        why_none: "the table is ours, and no paper has it",
        pictures: &[],
    };

    /// The place of the picture of this name among all.
    ///
    /// # Errors
    /// A [`Diagnostic`] that tells the names that there are.
    pub fn picture(&self, name: &str) -> Result<usize, Diagnostic> {
        let names: Vec<&str> = self.pictures.iter().map(|&(name, _)| name).collect();
        names.iter().position(|&known| known == name).ok_or_else(|| {
            let remedy = match names[..] {
                [] => "leave it out: this table has no pictures".to_owned(),
                _ => format!("ask for one of {}", names.join(", ")),
            };
            Diagnostic::usage(format_args!("there is no picture {name}"), remedy)
        })
    }
}

/// Jobs of a table with their results, in their order.
pub type Results<T> = Vec<(<T as Table>::Job, <T as Table>::Sample)>;

/// How the jobs of a table share the threads.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Threads {
    /// Jobs are measured side by side, each on one thread.
    OneEach,
    /// Jobs are measured one after the other, each on all threads.
    AllForEach,
}

/// Is told how far the work is, from any thread, and may stop it.
pub trait Observer: Sync {
    /// The work begins; it has so many parts.
    fn begin(&self, parts: u64);

    /// So many more parts are done.
    ///
    /// # Errors
    /// [`Halt`] if the work is to stop.
    fn done(&self, parts: u64) -> Result<(), Halt>;

    /// The job in hand is a search, and this is how far it is.
    ///
    /// # Errors
    /// [`Halt`] if the work is to stop.
    fn searched(&self, what: &str, progress: &Progress<'_>) -> Result<(), Halt>;
}

/// Nobody.
impl Observer for () {
    fn begin(&self, _parts: u64) {}

    fn done(&self, _parts: u64) -> Result<(), Halt> {
        Ok(())
    }

    fn searched(&self, _what: &str, _progress: &Progress<'_>) -> Result<(), Halt> {
        Ok(())
    }
}

/// Measures all jobs of `table`, and merges them. The result is the same on any number of threads.
///
/// # Errors
/// [`Halt`], as the observer returned it, or if the settings cannot be measured.
pub fn measure<T: Table>(
    table: &T,
    settings: &T::Settings,
    observer: &dyn Observer,
) -> Result<T::Summary, Halt> {
    let jobs = table.jobs(settings)?;
    observer.begin(jobs.iter().map(|job| table.parts(job)).sum());
    let measure = |job: T::Job| {
        let measured = table.measure(settings, &job, observer)?;
        observer.done(table.parts(&job))?;
        Ok((job, measured))
    };
    let results = match table.threads() {
        Threads::OneEach => threads::try_each(jobs, measure)?,
        Threads::AllForEach => jobs.into_iter().map(measure).collect::<Result<_, Halt>>()?,
    };
    table.merge(settings, results)
}

/// The fault of a radio field that was asked for.
pub(super) fn usage(problem: Problem) -> Halt {
    Diagnostic::usage(problem, problem.remedy()).into()
}

/// The layout of this seed that a description stands for.
pub(super) fn generated(description: &str, seed: u64) -> Result<Layout, Halt> {
    let generator: Generator = description.parse()?;
    Ok(generator.generate(seed)?)
}

/// A layout with the base where it is, or else in the middle, and its cell.
pub(super) fn based(mut layout: Layout) -> Result<(Layout, Cell), Halt> {
    let base = Setup::choose_base(&mut layout, None)?;
    Ok((layout, base))
}
