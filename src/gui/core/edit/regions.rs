//! Changes of the regions.

use crate::language::spoken;
use std::sync::Arc;

use crate::document::degrees;
use crate::gui::core::division::Division;
use crate::gui::core::document::{Document, Method};
use crate::gui::core::{boundaries, boundary_entry};
use crate::present::units::Units;
use crate::sessions::Region;
use crate::sessions::division::RegionChoice;
use crate::units::rad_from_deg;

use super::Edit;

/// The document after a change of its regions; `None` for a change of something else.
pub(super) fn apply(edit: &Edit, document: &Document) -> Option<Result<Document, String>> {
    Some(match edit {
        Edit::Rename(region, name) => renamed(document, *region, name),
        Edit::KeepRegions => {
            let mut next = document.clone();
            next.division = Division::Given;
            Ok(next)
        }
        _ => divided(edit, document)?.and_then(|(regions, division)| {
            let mut next = document.clone();
            next.loaded_model = None;
            by_regions(&mut next, regions)?;
            next.division = division;
            Ok(next)
        }),
    })
}

/// The regions after a change of them, and how they came about.
fn divided(edit: &Edit, document: &Document) -> Option<Result<(Vec<Region>, Division), String>> {
    let loaded_session = &document.loaded_session;
    let resolved = |choice: RegionChoice| {
        let regions = choice.resolve(&loaded_session.session);
        regions.map_err(|e| spoken(e.describe()))
    };
    let by_hand = |regions: Option<Vec<Region>>, otherwise: &str| {
        let regions = regions.ok_or_else(|| otherwise.to_owned())?;
        Ok((regions, Division::Given))
    };
    let all = &document.regions;
    Some(match edit {
        Edit::Divide(number) => {
            resolved(RegionChoice::Uniform(*number)).map(|regions| (regions, Division::Even))
        }
        Edit::RegionsOfSession => {
            resolved(RegionChoice::FromSession).map(|regions| (regions, Division::Given))
        }
        Edit::Adapt(regions, decision) => {
            Ok((regions.to_vec(), Division::Adaptive(decision.clone())))
        }
        Edit::MoveBoundary(boundary, to_rad) => by_hand(
            boundaries::moved(all, *boundary, *to_rad, loaded_session.travel()),
            say!("the boundary cannot be moved there"),
        ),
        Edit::PlaceBoundary(joint, at_rad) => boundary_entry::placed(
            all,
            *joint,
            *at_rad,
            loaded_session.travel(),
            Units::default(),
        )
        .map(|regions| (regions, Division::Given)),
        Edit::Split(region) => by_hand(
            boundaries::split(all, *region),
            say!("the region is too narrow to be split"),
        ),
        Edit::Join(region) => by_hand(
            boundary_entry::joined(all, *region),
            say!(
                "no region begins where this one ends; enter the end of this region as the start of the next one first"
            ),
        ),
        Edit::Delete(region) => by_hand(
            boundary_entry::without(all, *region),
            say!("the last region stays: without one nothing is corrected"),
        ),
        _ => return None,
    })
}

fn renamed(document: &Document, region: usize, name: &str) -> Result<Document, String> {
    let name = name.trim();
    if name.is_empty() {
        return Err(say!("a region needs a name").to_owned());
    }
    let taken = |(k, r): (usize, &Region)| k != region && r.name == name;
    if document.regions.iter().enumerate().any(taken) {
        return Err(say!(
            "another region is called {name}; choose another name",
            name = name
        ));
    }
    let mut regions = document.regions.to_vec();
    let renamed = regions
        .get_mut(region)
        .ok_or(say!("there is no such region"))?;
    name.clone_into(&mut renamed.name);
    let mut next = document.clone();
    next.regions = regions.into();
    Ok(next)
}

/// Regions that are worked on are regions that are wanted: the answer follows them at once.
fn by_regions(document: &mut Document, regions: Vec<Region>) -> Result<(), String> {
    if !document.loaded_session.single_revolute() {
        return Err(say!("regions are for a single joint that turns").to_owned());
    }
    // Exactly as a file will have them: what is saved is read again to the last bit.
    let as_saved = |region: Region| Region {
        from_rad: rad_from_deg(degrees(region.from_rad)),
        to_rad: rad_from_deg(degrees(region.to_rad)),
        ..region
    };
    let regions: Vec<Region> = regions.into_iter().map(as_saved).collect();
    // Regions that stay as they are stay the same to everything that looks at them.
    if document.regions[..] != regions[..] {
        document.regions = Arc::from(regions);
    }
    document.method = Method::Regional;
    document.identified = true;
    Ok(())
}
