//! A tree of panes: its leaves are panes, a split divides its room among its parts by their shares.

use serde::{Deserialize, Serialize};

use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::Quantity;

/// Splits within splits, at most.
pub(super) const DEEPEST: usize = 8;

/// A pane by its number: it keeps it while it is moved.
pub(crate) type Key = u32;

/// How a chart is looked at.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct ChartPane {
    /// The chart by its name; `None`: what suits the step.
    pub(crate) chart: Option<String>,
    /// `None`: that of the view.
    pub(crate) component: Option<Component>,
    /// The joint that it is about, counted from 0; `None`: that of the view.
    pub(crate) joint: Option<usize>,
    /// What a scatter has across and upwards; `None`: as it begins.
    pub(crate) axes: Option<[Quantity; 2]>,
    /// Counts up when it is to show everything.
    #[serde(skip)]
    pub(crate) fitted: u64,
}

/// What stands in a pane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Content {
    Workspace,
    Chart(ChartPane),
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pane {
    #[serde(skip)]
    pub(crate) key: Key,
    pub(crate) shows: Content,
}

/// A part of a split, and how much of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SplitShare {
    pub(crate) share: f32,
    pub(crate) tile: Tile,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Tile {
    Pane(Pane),
    /// Side by side.
    Beside(Vec<SplitShare>),
    /// One below the other.
    Below(Vec<SplitShare>),
}

/// An edge of a pane, or of the whole middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edge {
    Left,
    Right,
    Top,
    Bottom,
}

impl Edge {
    pub(crate) const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Top, Self::Bottom];

    fn is_sideways(self) -> bool {
        matches!(self, Self::Left | Self::Right)
    }
}

impl Tile {
    /// Of a split: whether its parts stand side by side, and which they are.
    pub(crate) fn parts(&self) -> Option<(bool, &[SplitShare])> {
        match self {
            Self::Pane(_) => None,
            Self::Beside(parts) => Some((true, parts)),
            Self::Below(parts) => Some((false, parts)),
        }
    }

    pub(super) fn split(side_by_side: bool, parts: Vec<SplitShare>) -> Self {
        if side_by_side {
            Self::Beside(parts)
        } else {
            Self::Below(parts)
        }
    }

    /// Whether its parts stand side by side, and which they are.
    fn into_parts(self) -> Result<(bool, Vec<SplitShare>), Self> {
        match self {
            Self::Beside(parts) => Ok((true, parts)),
            Self::Below(parts) => Ok((false, parts)),
            pane @ Self::Pane(_) => Err(pane),
        }
    }

    pub(super) fn gather<'a>(&'a self, all: &mut Vec<&'a Pane>) {
        match self {
            Self::Pane(pane) => all.push(pane),
            Self::Beside(parts) | Self::Below(parts) => {
                for part in parts {
                    part.tile.gather(all);
                }
            }
        }
    }

    pub(super) fn find(&mut self, key: Key) -> Option<&mut Pane> {
        match self {
            Self::Pane(pane) => (pane.key == key).then_some(pane),
            Self::Beside(parts) | Self::Below(parts) => {
                parts.iter_mut().find_map(|part| part.tile.find(key))
            }
        }
    }

    /// The same with every pane exchanged for what `of` makes of it, nothing that is empty or alone in
    /// a split, and no split within one of its own direction.
    pub(super) fn map(
        self,
        depth: usize,
        of: &mut impl FnMut(Pane) -> Option<Self>,
    ) -> Option<Self> {
        let (side_by_side, parts) = match self.into_parts() {
            Err(Self::Pane(pane)) => return of(pane),
            Err(_) => return None,
            Ok(split) => split,
        };
        if depth == 0 {
            return None;
        }
        let mut kept: Vec<SplitShare> = Vec::new();
        for SplitShare { share, tile } in parts {
            let Some(tile) = tile.map(depth - 1, of) else {
                continue;
            };
            let share = if share.is_finite() && share > 0.0 {
                share.clamp(1e-3, 1e6)
            } else {
                1.0
            };
            match tile.into_parts() {
                Ok((same, inner)) if same == side_by_side => {
                    let all: f32 = inner.iter().map(|part| part.share).sum();
                    kept.extend(inner.into_iter().map(|part| SplitShare {
                        share: share * part.share / all,
                        ..part
                    }));
                }
                Ok((other, inner)) => kept.push(SplitShare {
                    share,
                    tile: Self::split(other, inner),
                }),
                Err(tile) => kept.push(SplitShare { share, tile }),
            }
        }
        if kept.len() < 2 {
            return kept.pop().map(|part| part.tile);
        }
        let all: f32 = kept.iter().map(|part| part.share).sum();
        for part in &mut kept {
            part.share /= all;
        }
        Some(Self::split(side_by_side, kept))
    }
}

/// A tile at an edge of another, with its share of both.
pub(super) fn at_edge(tile: Tile, share: f32, new: Tile, edge: Edge) -> Tile {
    let part = |share, tile| SplitShare { share, tile };
    let mut parts = vec![part(1.0 - share, tile), part(share, new)];
    if matches!(edge, Edge::Left | Edge::Top) {
        parts.reverse();
    }
    Tile::split(edge.is_sideways(), parts)
}
