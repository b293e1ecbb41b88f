//! The recursive chain (paper 000, III) as a scheme: the kernel's chain, the log of messages that it reads its
//! history from, and the smallest grid that holds its area.

use tautline_kernel::chain::{self, Chain, Intent, MAX_ROBOTS, Refused};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Edge, Grid, MediumGrid, SmallGrid};
use tautline_proofs::chain::breach::frame;
use tautline_proofs::chain::breach::{Breach, CHEAP_LOOKS};
use tautline_proofs::run::Frame;

use super::floor::Component;
use super::{Chart, End, Scheme, Setup, missed};
use crate::fault::Fault;
use crate::layout::Layout;
use crate::wide::WideGrid;

struct ChainScheme<G, const ROBOTS: usize> {
    chain: Chain<G, ROBOTS>,
    log: Vec<u8>,
}

/// The chain of `setup`, all robots at the base.
pub(super) fn start(setup: &Setup) -> Result<Box<dyn Scheme>, Fault> {
    match setup.robots {
        0..=8 => begin::<_, 8>(setup, SmallGrid::new),
        9..=32 => begin::<_, 32>(setup, MediumGrid::new),
        _ => begin::<_, MAX_ROBOTS>(setup, |area| Some(WideGrid::new(area))),
    }
    .map_err(|refused| Fault::usage(refused, remedy(refused)))
}

fn begin<G: Grid + 'static, const ROBOTS: usize>(
    setup: &Setup,
    grid: impl Fn(Area) -> Option<G>,
) -> Result<Box<dyn Scheme>, Refused> {
    let (base, robots) = (setup.base, usize::from(setup.robots));
    let area = chain::area(setup.layout.size().area(), base, robots).ok_or(Refused::BaseOutside { base })?;
    let grid = grid(area).ok_or(Refused::TooManyRobots { robots, most: ROBOTS })?;
    let chain = Chain::<G, ROBOTS>::new(setup.rule.chain(), robots, base, grid)?;
    Ok(Box::new(ChainScheme { chain, log: Vec::new() }))
}

/// What would be right where a chain is refused.
pub(crate) fn remedy(refused: Refused) -> String {
    match refused {
        Refused::TooFewRobots { .. } | Refused::TooManyRobots { .. } => {
            format!("give --robots a number from 2 to {MAX_ROBOTS}")
        }
        Refused::BaseOutside { .. } => "give --base a free cell of the layout".to_owned(),
    }
}

impl<G: Grid, const ROBOTS: usize> Scheme for ChainScheme<G, ROBOTS> {
    fn area(&self) -> Area {
        self.chain.grid().area()
    }

    fn cells(&self) -> &[Cell] {
        self.chain.cells()
    }

    fn due(&self, layout: &Layout) -> u32 {
        self.area().cells().filter(|&cell| layout.is_free(cell)).count() as u32
    }

    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        match self.chain.plan(&self.log) {
            Ok(Intent::Go(plan)) => {
                let settled = self.chain.settle(&plan, is_open);
                self.log.extend_from_slice(settled.messages());
                Ok(frame(plan.kind, settled.messages(), self.chain.cells()))
            }
            Ok(Intent::Done(chain::End::Explored)) => Err(End::Explored),
            Ok(Intent::Done(chain::End::Exhausted)) => Err(End::Exhausted),
            Err(damaged) => unreachable!("the log holds what the chain has sent, but {damaged}"),
        }
    }

    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<Breach> {
        let is_costly = self.chain.looked_at() > CHEAP_LOOKS * before.len() as u32;
        let seen = Breach::CHAIN.into_iter().filter(|breach| breach.is_in(before, &frame.cells));
        seen.chain(is_costly.then_some(Breach::Costly)).collect()
    }

    fn broken_at_end(&self, setup: &Setup, chart: &Chart, _: End) -> Vec<Breach> {
        if missed(setup, chart).is_empty() { Vec::new() } else { vec![Breach::Completeness] }
    }

    fn marked(&self) -> &[(Cell, Mark)] {
        &[]
    }

    fn unseen(&self) -> &[Cell] {
        &[]
    }

    fn components(&self) -> &[Component] {
        &[]
    }

    fn milliseconds(&self) -> Option<u64> {
        None
    }
}
