//! The tables and figures of the papers and SPEC.md, measured again. A table is a row of [`TABLES`]: its settings, jobs
//! that know nothing of each other, and how their results become a text, JSON and pictures. A new table is a file of
//! its own and one line here.

pub mod agents;
pub mod antenna_fig4;
pub mod atlas;
pub mod chain_fig4;
pub mod chain_radio;
mod columns;
mod csv;
mod entry;
mod estimates;
pub mod floors;
pub mod floors_missed;
pub mod frontier_fig7;
pub mod journeys;
pub mod kit;
pub mod locate_convergence;
pub mod locate_explore;
pub mod locate_fig8;
pub mod margins;
pub mod notice_fig5;
pub mod optimum;
mod paper;
pub mod parameter;
mod prelude;
pub mod reel;
pub mod repair_cost;
pub mod rescue_fig8;
pub mod rescue_table2;
pub mod rivals;
mod runs;
pub mod sentences;
mod table;

pub(crate) use self::entry::AS_WRITTEN;
pub use self::entry::{Entry, Experiment, Report};
pub use self::table::{Description, Observer, Results, Table, Threads, measure};

/// Every table, in the order in which they are listed.
pub const TABLES: &[&dyn Entry] = &[
    &repair_cost::RepairCost,
    &reel::Reel,
    &optimum::Optimum,
    &atlas::Atlas,
    &rivals::ChainTable1,
    &rivals::ChainFig3,
    &chain_fig4::ChainFig4,
    &chain_radio::ChainRadio,
    &agents::BRICKS_FIG11,
    &agents::BRICKS_FIG12,
    &agents::BRICKS_IDEAL,
    &floors::Floors,
    &floors_missed::FloorsMissed,
    &antenna_fig4::AntennaFig4,
    &notice_fig5::NoticeFig5,
    &journeys::RESCUE_FIG6,
    &journeys::RESCUE_FIG7,
    &rescue_fig8::RescueFig8,
    &journeys::RESCUE_FIG9,
    &journeys::RESCUE_FIG10,
    &journeys::RESCUE_SHAPES,
    &rescue_table2::RescueTable2,
    &kit::KIT_FIG9,
    &kit::KIT_FIG14,
    &kit::KitRange,
    &margins::Margins,
    &frontier_fig7::FrontierFig7,
    &locate_fig8::LocateFig8,
    &locate_convergence::LocateConvergence,
    &locate_explore::LocateExplore,
];

/// The table of this name.
pub fn find(id: &str) -> Option<&'static dyn Entry> {
    TABLES.iter().copied().find(|table| table.about().id == id)
}
