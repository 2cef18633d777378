use super::*;

fn keys(panes: &Panes) -> Vec<Key> {
    panes.panes().iter().map(|pane| pane.key).collect()
}

#[test]
fn a_chart_is_split_off_beside_and_below_and_closed_again() {
    let mut panes = Panes::default();
    assert_eq!(panes.outline(), "(1 2 )");
    panes.split(2, Edge::Right, ChartPane::default());
    assert_eq!(panes.outline(), "(1 [2 3 ))");
    assert_eq!(panes.active(), 3);
    panes.split(3, Edge::Right, ChartPane::default());
    assert_eq!(
        panes.outline(),
        "(1 [2 3 4 ))",
        "one split, not one in another"
    );
    panes.split(1, Edge::Left, ChartPane::default());
    assert_eq!(panes.outline(), "([5 1 )[2 3 4 ))");
    for key in [3, 5, 2, 4] {
        panes.close(key);
        assert_eq!(panes.clone().sound(|_| true), panes);
    }
    assert_eq!(panes.outline(), "1 ");
    assert_eq!(panes.active(), 1);
    assert!(panes.active_chart().is_none());
    panes.close(1);
    assert_eq!(panes.outline(), "1 ", "the workspace stays");
    panes.split(1, Edge::Bottom, ChartPane::default());
    assert_eq!(panes.outline(), "(1 2 )");
}

#[test]
fn shares_are_kept_where_a_pane_is_split_and_given_to_the_neighbours_where_it_is_closed() {
    let mut panes = Panes::default();
    let share = |panes: &Panes, k: usize| panes.root.parts()[k].share;
    panes.split(2, Edge::Right, ChartPane::default());
    assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
    panes.close(3);
    assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
    // Stacked, the new one has half of what it is split from.
    panes.split(2, Edge::Bottom, ChartPane::default());
    assert_eq!(panes.outline(), "(1 2 3 )");
    assert!((share(&panes, 1) - share(&panes, 2)).abs() < 1e-6);
    assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
}

#[test]
fn a_pane_is_moved_to_any_edge_of_the_middle() {
    for (edge, outline) in [
        (Edge::Left, "[2 1 )"),
        (Edge::Right, "[1 2 )"),
        (Edge::Top, "(2 1 )"),
        (Edge::Bottom, "(1 2 )"),
    ] {
        let mut panes = Panes::default();
        panes.move_to(2, edge);
        assert_eq!(panes.outline(), outline);
        panes.move_to(99, edge);
        assert_eq!(panes.outline(), outline);
    }
    let mut alone = Panes::default();
    alone.close(2);
    alone.move_to(1, Edge::Left);
    assert_eq!(alone.outline(), "1 ");
}

#[test]
fn there_are_never_too_many_charts_and_always_one_workspace() {
    let mut panes = Panes::default();
    for _ in 0..20 {
        panes.split(panes.active(), Edge::Left, ChartPane::default());
    }
    assert_eq!(panes.charts().count(), MOST_CHARTS);
    assert!(!panes.has_room());
    let part = |tile: Tile| SplitShare {
        share: f32::NAN,
        tile,
    };
    let pane = |shows: Content| Tile::Pane(Pane { key: 7, shows });
    let chart = |name: &str| {
        let chart = Some(name.to_owned());
        pane(Content::Chart(ChartPane {
            chart,
            ..ChartPane::default()
        }))
    };
    let read = |tiles: Vec<Tile>| {
        let root = Tile::Beside(tiles.into_iter().map(part).collect());
        let panes = Panes {
            root,
            active: 0,
            chart: 0,
        };
        panes.sound(|name| name != "gone")
    };
    let workspace = || pane(Content::Workspace);
    assert_eq!(read(vec![]), Panes::default());
    assert_eq!(
        read(vec![chart("histogram")]),
        Panes::default(),
        "no workspace"
    );
    let two = read(vec![
        workspace(),
        chart("histogram"),
        chart("gone"),
        workspace(),
    ]);
    assert_eq!(two.charts().count(), 1);
    assert_eq!(keys(&two).len(), 2);
    let parts = two.root.parts().iter();
    assert!(parts.clone().all(|part| (part.share - 0.5).abs() < 1e-6));
    let mut deep = workspace();
    for k in 0..40 {
        deep = Tile::split(k % 2 == 0, vec![part(deep), part(chart("x"))]);
    }
    assert_eq!(Panes::of(deep), Panes::default());
}

#[test]
fn what_is_kept_comes_back() {
    let mut panes = Panes::default();
    panes.split(1, Edge::Right, ChartPane::default());
    panes.split(3, Edge::Bottom, ChartPane::default());
    if let Some(chart) = panes.chart_mut(3) {
        chart.chart = Some("scatter".to_owned());
        chart.component = Some(Component::Radial);
        chart.axes = Some([Quantity::Order, Quantity::Measured(2)]);
    }
    let text = serde_json::to_string(&panes).expect("it can be written");
    let read: Panes = serde_json::from_str(&text).expect("it can be read");
    let read = read.sound(|_| true);
    let again = serde_json::to_string(&read).expect("it can be written");
    assert_eq!(again, text);
    assert_eq!(read.outline().len(), panes.outline().len());
    assert!(!read.are_usual() && Panes::default().are_usual());
}

#[test]
fn the_next_plot_is_the_next_in_sight_and_after_the_last_the_first() {
    let mut panes = Panes::default();
    panes.split(1, Edge::Right, ChartPane::default());
    let order = keys(&panes);
    panes.activate(order[0]);
    for key in order.iter().cycle().skip(1).take(7) {
        panes.activate_next();
        assert_eq!(panes.active(), *key);
    }
}
