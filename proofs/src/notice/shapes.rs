//! Every small network, one of each shape.

use super::spread::Links;

/// The largest network of which every state is looked at.
pub const SMALL: usize = 5;

/// Every connected network of at most [`SMALL`] nodes, one of each shape as seen from the source, the smallest first.
pub(super) fn shapes() -> Vec<Links<SMALL>> {
    let mut shapes = Vec::new();
    for nodes in 1..=SMALL {
        let pairs: Vec<(usize, usize)> =
            (0..nodes).flat_map(|one| (one + 1..nodes).map(move |other| (one, other))).collect();
        let orders = orders(nodes);
        let drawn = |set: u32, order: &[usize]| {
            let mut links = Links::NONE;
            for (_, &(one, other)) in pairs.iter().enumerate().filter(|(place, _)| set >> place & 1 == 1) {
                links.add(order[one], order[other]);
            }
            links
        };
        let mut sets: Vec<u32> = (0..1 << pairs.len()).collect();
        sets.sort_by_key(|set| set.count_ones());
        let all = (1 << nodes) - 1;
        let shape = |set: u32| {
            let links = drawn(set, &orders[0]);
            let is_first = || orders.iter().all(|order| links <= drawn(set, order));
            (links.component() == all && is_first()).then_some(links)
        };
        shapes.extend(sets.into_iter().filter_map(shape));
    }
    shapes
}

/// Every order of `nodes` that leaves the source in its place.
fn orders(nodes: usize) -> Vec<Vec<usize>> {
    let mut orders = vec![vec![0]];
    for node in 1..nodes {
        let longer = |order: Vec<usize>| {
            (1..=node).map(move |place| {
                let mut longer = order.clone();
                longer.insert(place, node);
                longer
            })
        };
        orders = orders.into_iter().flat_map(longer).collect();
    }
    orders
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_one_network_of_each_shape() {
        let shapes = shapes();
        let of_size =
            |nodes: u32| shapes.iter().filter(|links| links.component().count_ones() == nodes).count();
        assert_eq!([1, 2, 3, 4, 5].map(of_size), [1, 1, 3, 11, 58]);
    }
}
