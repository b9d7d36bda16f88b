//! The cheapest way for a rover over ground with heights: in time, in energy, or in what it risks.
//! Energy is what the motors draw where they are known, else the work of the wheels.
//!
//! Ways lead over a lattice of the ground's points, in sixteen directions; a way over level ground
//! is at most 2.8 % longer than the straight line. What a metre costs comes from the
//! [tables](super::mobility) of the steady motion that holds its course: by how steeply the ground
//! rises along the way and across it. Turns are made on the spot, and cost what a turn on level
//! ground does. No way leads where no heading holds the course, or where more of the samples than
//! the [`Limits`] allow say no-go. A sample that gets stuck in a turn does not complete the way.
//!
//! A way at the least *risk* is the one whose time is least in the worst tenth of the samples of
//! soil and model: for each metre the mean over those, the conditional value at risk, in which a
//! sample that is stuck counts as a detour of [`STUCK_WAY`]. That adds up along the way if one soil
//! is the better one everywhere, as it is where the soil of the whole ground is not known.

mod along;
mod answer;
mod corridor;
mod costs;
mod drive;
mod end;
mod hazard;
mod legs;
mod measure;
mod moves;
mod profile;
mod search;
mod seek;
mod study;
mod turns;

pub use self::along::{CheckedLine, Line};
pub use self::answer::{
    Answer, Arrival, Ends, JudgedAnswer, LineError, MOST_CELLS, NoRoute, Route, RouteError,
};
pub use self::costs::{COURSES, RouteTables};
pub use self::drive::DrivenRoute;
pub use self::end::{EndPlace, RouteRisk};
pub use self::hazard::{Danger, Hazard};
pub use self::legs::{JudgedLeg, LegPlace, LegPlaces};
pub use self::profile::{GroundOfPiece, ProfilePiece};
pub use self::study::{Limits, Objective, RouteStudy, STUCK_WAY, WORST_SHARE};

#[cfg(test)]
mod tests {
    use grouser_raster::{CoordinateSystem, Raster};

    use super::costs::Costs;
    use super::moves::DIRECTIONS;
    use super::search::{Found, Lattice};
    use super::*;
    use crate::soil::Soil;
    use crate::studies::ensemble::samples::{BandInputs, Sample};
    use crate::studies::mobility::Ground;
    use crate::studies::verdict::{Holding, SlopeStudy, SpotTurn, SpotTurns, Verdict};
    use crate::terrain::{ElevationGrid, SoilZones, ZonePolygon};
    use crate::units::{Vec2, deg};
    use grouser_io::{self as document, Overrides, Source};

    /// Ground whose height is given over x and y [m].
    fn ground_of(
        columns: usize,
        rows: usize,
        spacing: f64,
        height: impl Fn(Vec2) -> f64,
    ) -> Raster {
        let spacing = Vec2::new(spacing, spacing);
        let grid = ElevationGrid { columns, rows, south_west: Vec2::zeros(), spacing };
        #[expect(clippy::cast_possible_truncation, reason = "heights of a test")]
        let heights = grid.points().map(|at| height(at) as f32).collect();
        Raster {
            grid,
            base: 0.0,
            heights,
            coordinates: CoordinateSystem::default(),
            remarks: Vec::new(),
        }
    }

    /// Hills that nothing repeats.
    fn hills(at: Vec2) -> f64 {
        1.1 * f64::sin(0.31 * at.x + 0.4) * f64::cos(0.23 * at.y)
            + 0.5 * f64::sin(0.57 * at.y - 0.2 * at.x)
    }

    fn study() -> RouteStudy {
        let scenario =
            document::read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap();
        let mobility = SlopeStudy::of(&scenario);
        let limits = Limits::of(&mobility);
        RouteStudy { mobility, limits, keep_out: None }
    }

    fn ends(from: [f64; 2], to: [f64; 2]) -> Ends {
        Ends { from: Vec2::from(from), to: Vec2::from(to), yaw: None }
    }

    /// With the risk.
    fn tables(study: &RouteStudy) -> RouteTables {
        study.tables(&[], true, &|| true).unwrap().unwrap()
    }

    fn answer(study: &RouteStudy, raster: &Raster, ends: &Ends, objective: Objective) -> Answer {
        let ground = Ground::under(&study.mobility.heading.rover, raster);
        study.route(&tables(study), ground, ends, objective).unwrap()
    }

    fn route(study: &RouteStudy, raster: &Raster, ends: &Ends, objective: Objective) -> Route {
        match answer(study, raster, ends, objective) {
            Answer::Route(route) => route,
            Answer::NoSafeRoute(reason) => panic!("{reason}"),
        }
    }

    #[test]
    fn over_level_ground_a_way_is_nearly_straight() {
        let (study, raster) = (study(), ground_of(60, 60, 0.5, |_| 3.0));
        for (x, y) in [(25.0, 0.0), (25.0, 12.5), (25.0, 7.0), (11.0, 24.5), (3.5, 20.0)] {
            let found =
                route(&study, &raster, &ends([2.0, 2.0], [2.0 + x, 2.0 + y]), Objective::Time);
            let straight = f64::hypot(x, y);
            assert!((1.0 - 1e-9..1.028).contains(&(found.length / straight)), "{x} {y}: {found:?}");
            assert!((found.length - found.map_length).abs() < 1e-9);
        }
        let found = route(&study, &raster, &ends([2.0, 2.0], [27.0, 2.0]), Objective::Energy);
        let motion =
            study.mobility.table(0.0, &[], &|| true).unwrap().unwrap().motion(0.0).unwrap();
        assert_eq!(found.waypoints.len(), 2);
        assert!(
            (found.energy / (25.0 * motion.energy_per_metre()) - 1.0).abs() < 1e-6,
            "{found:?}"
        );
        assert!((found.time / (25.0 / motion.speed) - 1.0).abs() < 1e-6, "{found:?}");
    }

    /// The price of the way that a search finds, with its turns.
    fn price_of(lattice: &Lattice<'_>, found: &Found, turn: f64) -> f64 {
        let Found::Way(way, headings) = found else { panic!("there is a way") };
        let moves =
            way.iter().zip(headings).map(|(cell, heading)| lattice.price(*cell, *heading).1);
        let turns =
            headings.windows(2).map(|pair| turn * lattice.moves.turn(pair[0], pair[1]).abs());
        moves.sum::<f64>() + turns.sum::<f64>()
    }

    /// The search agrees with another one, Dijkstra's, which is not guided.
    #[test]
    fn the_way_is_the_cheapest_there_is() {
        let (study, raster) = (study(), ground_of(34, 30, 0.8, hills));
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        for objective in Objective::ALL {
            let tables = tables(&study);
            let costs = Costs::of(&tables, objective);
            assert!(costs.bound.level > 0.0, "{:?}", costs.bound);
            let turn = 5.0;
            let lattice = Lattice::new(ground, &costs, turn, |_| true);
            let (from, to) = (2 * 34 + 2, 26 * 34 + 30);
            let guided = price_of(&lattice, &lattice.search(from, to, Some(3)), turn);
            // The other takes no negative prices: what the height is worth is counted as it is
            // gained.
            let worth = |cell: usize| costs.bound.climb * f64::from(raster.heights[cell]);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive")]
            let micro = |price: f64| (price * 1e6).round() as u64;
            let next = |&(cell, heading): &(usize, usize)| {
                let (ahead, price) = lattice.price(cell, heading);
                let left = (heading + 1) % DIRECTIONS;
                let right = (heading + DIRECTIONS - 1) % DIRECTIONS;
                let turned = |it: usize| micro(turn * lattice.moves.to_next[it]);
                let lost = price + worth(cell) - worth(ahead);
                let drive = price.is_finite().then(|| ((ahead, heading), micro(lost)));
                let turns = [((cell, left), turned(heading)), ((cell, right), turned(right))];
                drive.into_iter().chain(turns).collect::<Vec<_>>()
            };
            let (_, exact) =
                pathfinding::prelude::dijkstra(&(from, 3), next, |(cell, _)| *cell == to).unwrap();
            let exact = exact as f64 / 1e6 + worth(to) - worth(from);
            // The first turns, from the heading at the start, are not in the sum of the way.
            let Found::Way(_, headings) = lattice.search(from, to, Some(3)) else { panic!() };
            let first = turn * lattice.moves.turn(MOVED, headings[0]).abs();
            assert!(
                (guided + first - exact).abs() < 1e-4 * exact,
                "{objective:?} {guided} {exact}"
            );
        }
        const MOVED: usize = 3;
    }

    /// What a way costs at least is never more than a move less.
    #[test]
    fn the_guidance_is_consistent() {
        let (study, raster) = (study(), ground_of(40, 40, 0.8, hills));
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        for objective in Objective::ALL {
            let tables = tables(&study);
            let costs = Costs::of(&tables, objective);
            let lattice = Lattice::new(ground, &costs, 1.0, |_| true);
            let target = 31 * 40 + 17;
            let mut moves = 0;
            for (cell, heading) in
                (0..1600).flat_map(|cell| (0..DIRECTIONS).map(move |it| (cell, it)))
            {
                let (to, price) = lattice.price(cell, heading);
                if price.is_finite() {
                    let [here, there] = [cell, to].map(|it| lattice.at_least(it, target));
                    assert!(here <= there + price + 1e-5 * (1.0 + here.abs()), "{cell} {heading}");
                    moves += 1;
                }
            }
            assert!(moves > 10_000, "{moves}");
        }
    }

    /// Up a plane that can be climbed the way is straight; where straight up is not allowed it is a
    /// zigzag whose courses the limit allows, and its length that of the closed form.
    #[test]
    fn up_a_plane_the_way_is_straight_or_a_zigzag() {
        let mut study = study();
        let plane = |slope: f64| ground_of(81, 61, 0.5, move |at| at.y * deg(slope).tan());
        let up = ends([20.0, 2.0], [20.0, 27.0]);
        let straight = route(&study, &plane(8.0), &up, Objective::Time);
        assert!((straight.map_length - 25.0).abs() < 1e-9, "{straight:?}");
        assert!((straight.length - 25.0 / deg(8.0).cos()).abs() < 1e-4, "{straight:?}");
        // Straight up 14° slips more than the diagonal does.
        let tables = [90.0, 45.0].map(|course| study.mobility.table(deg(course), &[], &|| true));
        let slip =
            tables.map(|table| table.unwrap().unwrap().motion(deg(14.0)).unwrap().slip_ratio);
        study.limits.most_slip_ratio = 0.5 * (slip[0] + slip[1]);
        let zigzag = route(&study, &plane(14.0), &up, Objective::Time);
        assert!(zigzag.map_length > 1.1 * 25.0 && zigzag.turned > 0.5, "{zigzag:?}");
        assert!(zigzag.most_slip_ratio <= study.limits.most_slip_ratio);
        // Two legs along the steepest direction of the lattice that is left over, which is the
        // diagonal.
        assert!((zigzag.map_length - 25.0 * f64::sqrt(2.0)).abs() < 1e-9, "{zigzag:?}");
        assert_eq!(zigzag.waypoints.len(), 3);
        // Half-way up it has taken half of all but the turn, which comes after it.
        let [begin, half, end] = zigzag.arrivals[..] else { panic!("{zigzag:?}") };
        assert_eq!(begin, Arrival::default());
        assert!((half.length / end.length - 0.5).abs() < 1e-6, "{zigzag:?}");
        assert!(half.time < 0.5 * end.time && half.energy < 0.5 * end.energy, "{zigzag:?}");
        assert_eq!((end.length, end.time), (zigzag.length, zigzag.time));
    }

    #[test]
    fn mirrored_ground_has_the_mirrored_way() {
        let study = study();
        let raster = ground_of(50, 40, 0.8, hills);
        let mirrored = ground_of(50, 40, 0.8, |at| hills(Vec2::new(at.x, 39.0 * 0.8 - at.y)));
        let there = route(&study, &raster, &ends([4.0, 4.0], [36.0, 26.4]), Objective::Energy);
        let back = |y: f64| 39.0 * 0.8 - y;
        let other = route(
            &study,
            &mirrored,
            &ends([4.0, back(4.0)], [36.0, back(26.4)]),
            Objective::Energy,
        );
        assert!((there.energy - other.energy).abs() < 1e-3 * there.energy, "{there:?} {other:?}");
        assert!((there.time - other.time).abs() < 5e-3 * there.time, "{there:?} {other:?}");
    }

    #[test]
    fn each_objective_is_best_at_its_own() {
        let (study, raster) = (study(), ground_of(70, 60, 0.8, hills));
        let all = ends([4.0, 4.0], [48.0, 40.0]);
        let [fast, frugal, _] =
            Objective::ALL.map(|objective| route(&study, &raster, &all, objective));
        // What is sought is read from a table, and the sums are not.
        assert!(fast.time <= 1.001 * frugal.time, "{fast:?} {frugal:?}");
        assert!(frugal.energy <= 1.001 * fast.energy, "{fast:?} {frugal:?}");
    }

    #[test]
    fn a_way_leads_around_where_nobody_may_go() {
        let mut study = study();
        let raster = ground_of(60, 60, 0.5, |_| 0.0);
        let soils = vec![study.mobility.heading.soil];
        let wall = |from: f64, to: f64| {
            let corners = [(from, -1.0), (to, -1.0), (to, 20.0), (from, 20.0)];
            let rings = vec![corners.map(|(x, y)| Vec2::new(x, y)).to_vec()];
            let area = ZonePolygon { soil: Some(0), rings };
            Some(SoilZones::from_polygons(&[area], soils.clone()).unwrap())
        };
        // One that lies between the points of the grid, and one over several of them.
        for (from, to) in [(10.2, 10.3), (10.0, 13.0)] {
            study.keep_out = wall(from, to);
            let found = route(&study, &raster, &ends([3.0, 5.0], [24.0, 5.0]), Objective::Time);
            let around = f64::hypot(from - 3.0, 15.0) + to - from + f64::hypot(24.0 - to, 15.0);
            assert!(found.length > around && found.length < 1.06 * around + 2.0, "{found:?}");
        }
        let inside = answer(&study, &raster, &ends([11.0, 5.0], [24.0, 5.0]), Objective::Time);
        let Answer::NoSafeRoute(reason) = inside else { panic!("{inside:?}") };
        assert!(
            reason.to_string().contains("the start at x 11.00 m, y 5.00 m lies where nobody"),
            "{reason}"
        );
    }

    #[test]
    fn without_a_way_the_answer_says_why() {
        let study = study();
        // A wall of 60° from side to side.
        let wall = |at: Vec2| 6.0 * ((at.x - 14.0) / 3.0).clamp(0.0, 1.0);
        let raster = ground_of(60, 40, 0.5, wall);
        let cut = answer(&study, &raster, &ends([3.0, 5.0], [26.0, 5.0]), Objective::Time);
        let Answer::NoSafeRoute(NoRoute::Cut { reached, cells }) = cut else { panic!("{cut:?}") };
        assert!(reached > 400 && reached < cells / 2 + 200, "{reached} of {cells}");
        let on_the_wall = answer(&study, &raster, &ends([15.5, 5.0], [26.0, 5.0]), Objective::Time);
        assert!(
            matches!(on_the_wall, Answer::NoSafeRoute(NoRoute::End { end: "start", .. })),
            "{on_the_wall:?}"
        );
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let far = ends([3.0, 5.0], [99.0, 5.0]);
        let off = study.route(&tables(&study), ground, &far, Objective::Time);
        let error = off.unwrap_err().to_string();
        assert!(
            error.starts_with("the target at x 99.00 m, y 5.00 m is not on the map"),
            "{error}"
        );
    }

    /// Over hills, with turns: time and work by the tables are those of the simulation within a
    /// tenth.
    #[test]
    fn a_route_that_is_driven_takes_what_it_says() {
        let scenario =
            document::read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap().value;
        let (study, raster) = (study(), ground_of(60, 60, 0.8, |at| 0.6 * hills(at)));
        let model = std::sync::Arc::new(raster.clone().model().unwrap());
        for (objective, to) in [(Objective::Time, [14.0, 11.0]), (Objective::Energy, [4.0, 16.0])] {
            let found = route(&study, &raster, &ends([6.0, 6.0], to), objective);
            let driven = found.drive(&scenario, &model, study.mobility.rim_speed).unwrap();
            assert_eq!(driven.outcome, "completed");
            assert!(driven.miss < 0.2, "{driven:?}");
            assert!((driven.time / found.time - 1.0).abs() < 0.1, "{driven:?} {found:?}");
            assert!((driven.energy / found.energy - 1.0).abs() < 0.1, "{driven:?} {found:?}");
            assert!((driven.distance / found.length - 1.0).abs() < 0.05, "{driven:?} {found:?}");
        }
    }

    fn line(places: &[[f64; 2]]) -> Line {
        Line::through(places.iter().map(|it| Vec2::from(*it)).collect(), None).unwrap()
    }

    fn checked(study: &RouteStudy, raster: &Raster, line: &Line) -> CheckedLine {
        let ground = Ground::under(&study.mobility.heading.rover, raster);
        study.along(&tables(study), ground, line).unwrap()
    }

    /// To rounding from point to point of the grid; between points within what half a cell at
    /// either end takes, and the difference of bilinear heights from those of the move there.
    #[test]
    fn a_way_that_was_found_takes_the_same_when_it_is_read_back() {
        let (study, raster) = (study(), ground_of(60, 60, 0.8, hills));
        for (from, to, within) in
            [([4.0, 4.0], [36.0, 26.4], 1e-9), ([4.3, 4.1], [36.2, 26.1], 0.03)]
        {
            let found = route(&study, &raster, &ends(from, to), Objective::Time);
            let line = Line::through(found.waypoints.clone(), None).unwrap();
            let back = checked(&study, &raster, &line);
            assert!(within > 1e-3 || back.hazards.is_empty(), "{:?}", back.hazards);
            let back = back.route.unwrap();
            let near = |one: f64, other: f64| (one / other - 1.0).abs() < within;
            assert!(near(back.length, found.length), "{back:?} {found:?}");
            assert!(near(back.time, found.time) && near(back.energy, found.energy), "{back:?}");
            assert_eq!(back.probability_no_go, found.probability_no_go);
            assert_eq!(back.waypoints, found.waypoints);
            for (one, other) in back.arrivals.iter().zip(&found.arrivals).skip(1) {
                assert!((one.time - other.time).abs() < within * found.time, "{one:?} {other:?}");
            }
        }
    }

    /// Over a plane the motion is the same everywhere, so that a line's numbers are those of its
    /// course in closed form, whatever its angle to the grid is.
    #[test]
    fn over_a_plane_a_line_takes_what_its_course_does() {
        let study = study();
        let rise = deg(9.0).tan();
        let raster = ground_of(61, 61, 0.5, move |at| at.y * rise);
        for angle in [7.5, 15.0, 30.0, 52.5].map(deg) {
            // The direction on the map of a course on the slope.
            let way = Vec2::new(angle.cos(), angle.sin() * deg(9.0).cos());
            let (start, end) = (Vec2::new(3.1, 3.3), Vec2::new(3.1, 3.3) + 15.0 * way);
            let line = line(&[start.into(), end.into()]);
            let found = checked(&study, &raster, &line);
            assert!(found.hazards.is_empty(), "{found:?}");
            let route = found.route.unwrap();
            // One along the slope: cos² + sin² cos² + sin² sin² = 1.
            assert!((route.length - 15.0).abs() < 1e-4, "{route:?}");
            let table = study.mobility.table(angle, &[], &|| true).unwrap().unwrap();
            let motion = table.motion(deg(9.0)).unwrap();
            assert!((route.time * motion.speed / 15.0 - 1.0).abs() < 2e-3, "{route:?} {motion:?}");
            let energy = 15.0 * motion.energy_per_metre();
            assert!((route.energy / energy - 1.0).abs() < 5e-3, "{route:?} {energy}");
        }
    }

    #[test]
    fn where_a_line_is_not_safe_is_named() {
        let mut study = study();
        // 30° steep from x 14 to 17 m, with a place without a height at (22, 10).
        let mut raster =
            ground_of(60, 40, 0.5, |at| deg(30.0).tan() * (at.x - 14.0).clamp(0.0, 3.0));
        raster.heights[20 * 60 + 44] = f32::NAN;
        let corners = [(4.0, 9.0), (6.0, 9.0), (6.0, 12.0), (4.0, 12.0)];
        let rings = vec![corners.map(|(x, y)| Vec2::new(x, y)).to_vec()];
        let area = ZonePolygon { soil: Some(0), rings };
        let soils = vec![study.mobility.heading.soil];
        study.keep_out = Some(SoilZones::from_polygons(&[area], soils).unwrap());
        let found = checked(&study, &raster, &line(&[[2.0, 10.0], [28.0, 10.0]]));
        let named: Vec<(Danger, [f64; 2])> =
            found.hazards.iter().map(|it| (it.danger, it.along)).collect();
        let [(kept, inside), (steep, wall), (unknown, hole)] = named[..] else {
            panic!("{named:?}")
        };
        assert_eq!((kept, inside), (Danger::KeptOut, [2.0, 4.0]));
        assert_eq!(steep, Danger::NoHeading);
        assert!((wall[0] - 12.0).abs() <= 0.5 && (wall[1] - 15.0).abs() <= 0.5, "{wall:?}");
        assert_eq!(unknown, Danger::UnknownGround);
        assert!(hole[0] < 20.0 && hole[1] > 20.0 && hole[1] - hole[0] < 2.5, "{hole:?}");
        assert_eq!(found.route, None);
        // Beside all of that there is nothing to say.
        let free = checked(&study, &raster, &line(&[[2.0, 5.0], [12.0, 5.0], [12.0, 15.0]]));
        assert!(free.hazards.is_empty() && free.route.is_some(), "{free:?}");
        // A limit that is stricter names the worst of the stretch, and leaves the numbers.
        let slope = ground_of(60, 40, 0.5, |at| 0.1 * at.x);
        study.limits.most_slope = deg(5.0);
        let steep = checked(&study, &slope, &line(&[[2.0, 5.0], [12.0, 5.0]]));
        let [hazard] = steep.hazards[..] else { panic!("{steep:?}") };
        assert_eq!((hazard.danger, hazard.along), (Danger::TooSteep, [0.0, 10.0]));
        assert!((hazard.worst.unwrap() - 0.1_f64.atan()).abs() < 1e-6 && steep.route.is_some());
    }

    /// Of a rover whose motors are known the least energy is what they draw, which a steady drive on
    /// level ground takes by its motors' formula, and the simulation of a way within a tenth.
    #[test]
    fn the_least_energy_is_what_the_motors_draw() {
        let overrides = Overrides::parse(["rover.motor=maxon-a-max-22"]).unwrap();
        let loaded = document::read_scenario(&Source::default_scenario(), &overrides).unwrap();
        let mobility = SlopeStudy::of(&loaded);
        let limits = Limits::of(&mobility);
        let with_motors = RouteStudy { mobility, limits, keep_out: None };
        let level = ground_of(40, 40, 0.5, |_| 0.0);
        let far = ends([2.0, 2.0], [12.0, 2.0]);
        let found = route(&with_motors, &level, &far, Objective::Energy);
        let heading = with_motors.mobility.heading.curve().unwrap().at(0.0).unwrap();
        let rover = &with_motors.mobility.heading.rover;
        let speed = with_motors.mobility.rim_speed;
        let motors: f64 = rover
            .mounts()
            .iter()
            .zip(&heading.wheels)
            .map(|(mount, wheel)| {
                let motor = mount.unit.motor.expect("a motor");
                motor.at(wheel.settled.forces.torque, speed / mount.shearing_radius()).power
            })
            .sum();
        let expected = motors * found.time;
        let drawn = found.drawn.expect("motors are known");
        assert!((drawn / expected - 1.0).abs() < 1e-3, "{drawn} J, {expected} J");
        assert!(drawn > found.energy);
        // The same rover without: work is sought, and nothing is drawn that anybody knows.
        assert_eq!(route(&study(), &level, &far, Objective::Energy).drawn, None);
        let raster = ground_of(60, 60, 0.8, |at| 0.6 * hills(at));
        let far = ends([4.0, 4.0], [14.0, 14.0]);
        let [fast, frugal, _] =
            Objective::ALL.map(|objective| route(&with_motors, &raster, &far, objective));
        assert!(frugal.drawn.unwrap() <= 1.001 * fast.drawn.unwrap(), "{fast:?} {frugal:?}");
        let model = std::sync::Arc::new(raster.model().unwrap());
        let driven = frugal.drive(&loaded.value, &model, speed).unwrap();
        let ratio = driven.drawn.expect("motors are known") / frugal.drawn.unwrap();
        assert!((ratio - 1.0).abs() < 0.1, "{driven:?} {frugal:?}");
    }

    /// A study on an uncertain sand, with its samples and tables.
    fn uncertain() -> (RouteStudy, Vec<Sample>, RouteTables) {
        uncertain_within(|limits| limits)
    }

    /// The same with other limits than those of its rule.
    fn uncertain_within(
        change: impl FnOnce(Limits) -> Limits,
    ) -> (RouteStudy, Vec<Sample>, RouteTables) {
        let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"]).unwrap();
        let loaded = document::read_scenario(&Source::default_scenario(), &overrides).unwrap();
        let samples = BandInputs::of_scenario(&loaded).samples(1, 16).unwrap();
        let mobility = SlopeStudy::of(&loaded);
        let limits = change(Limits::of(&mobility));
        let study = RouteStudy { mobility, limits, keep_out: None };
        let tables = study.tables(&samples, false, &|| true).unwrap().unwrap();
        (study, samples, tables)
    }

    /// On level ground a rover turns from a way to the east to one to the north: of the samples those
    /// do not complete it that get stuck in that turn, as many as on the card's second page. Without
    /// the turn all complete it.
    #[test]
    fn samples_that_get_stuck_in_a_turn_do_not_complete_the_way() {
        let (study, samples, _) = uncertain();
        // Where a sand carries little the sides cannot turn the rover.
        let weak = |sample: &Sample| {
            let soil = Soil { friction_angle: deg(12.0), ..sample.soil };
            Sample { soil, ..sample.clone() }
        };
        let of = |(place, sample): (usize, &Sample)| {
            if place % 4 == 0 { weak(sample) } else { sample.clone() }
        };
        let samples: Vec<Sample> = samples.iter().enumerate().map(of).collect();
        let tables = study.tables(&samples, false, &|| true).unwrap().unwrap();
        let raster = ground_of(40, 40, 0.5, |_| 0.0);
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let risk_of = |places: &[[f64; 2]]| {
            let found = study.along(&tables, ground, &line(places)).unwrap();
            found.seen.risk.unwrap()
        };
        let straight = risk_of(&[[3.0, 3.0], [15.0, 3.0]]).completion;
        let bent = risk_of(&[[3.0, 3.0], [9.0, 3.0], [9.0, 9.0]]);
        let turns = SpotTurns::of(&study.mobility, &samples);
        let turned = turns.turned(&SpotTurn::moments(0.0, 0.0, deg(90.0)));
        let stuck = turned.iter().filter(|it| **it == Holding::Not).count();
        assert_eq!(straight.completed.successes, samples.len(), "{straight:?}");
        assert!(stuck > 0, "some get stuck");
        assert_eq!(bent.completion.completed.successes, samples.len() - stuck);
        let end = bent.completion.commonest.unwrap();
        assert_eq!((end.leg, end.outcome, end.count), (2, "no-turn", stuck));
        assert_eq!(bent.end.unwrap().place, Vec2::new(9.0, 3.0));
    }

    /// A way that leads from level ground up a slope, or down from there, turns on the level part once
    /// turns are kept off the slope, and is no shorter for it.
    #[test]
    fn turns_are_kept_off_slopes_on_which_they_are_a_no_go() {
        let (study, _, mut tables) = uncertain();
        let raster = ground_of(40, 44, 0.5, |at| (at.y - 10.0).max(0.0) * deg(6.0).tan());
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let pairs =
            [([5.0, 4.0], [12.0, 17.0]), ([5.0, 17.0], [12.0, 4.0])].map(|(a, b)| ends(a, b));
        let steepest_turn = |tables: &RouteTables| {
            pairs.map(|ends| match study.route(tables, ground, &ends, Objective::Time).unwrap() {
                Answer::Route(route) => {
                    let turns = route.turns.iter().map(|turn| turn.gradient.norm());
                    (turns.fold(f64::NAN, f64::max), route.time)
                }
                Answer::NoSafeRoute(why) => panic!("{why}"),
            })
        };
        let free = steepest_turn(&tables);
        assert!(tables.keep_turns_off(deg(1.0)) && !tables.keep_turns_off(deg(2.0)));
        let kept_off = steepest_turn(&tables);
        assert!(free.iter().any(|it| it.0 > deg(5.0).tan()), "there is something to keep off");
        for (free, kept_off) in free.iter().zip(&kept_off) {
            assert!(kept_off.0 <= 1e-9 && kept_off.1 >= free.1 - 1e-6, "{free:?} {kept_off:?}");
        }
    }

    /// Along a slope, and where it bends up a gentler one: the leg has the worse of both verdicts,
    /// although the way up is less steep.
    #[test]
    fn a_gentler_place_on_a_worse_course_is_not_hidden() {
        let (study, samples, tables) = uncertain();
        let [across, up] = [deg(11.0), deg(10.0)];
        let raster = ground_of(30, 60, 0.5, |at| {
            let rise = (at.y - 14.0).max(0.0) * up.tan();
            rise + if at.y < 14.0 { (at.x - 7.0) * across.tan() } else { 0.0 }
        });
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let found = study.along(&tables, ground, &line(&[[7.0, 3.0], [7.0, 27.0]])).unwrap();
        let legs = found.seen.advice(&study.mobility, &samples, &|| true).unwrap().unwrap();
        let [Some(leg)] = &legs[..] else { panic!("{legs:?}") };
        let verdict = |slope: f64, course: f64| {
            let all = study.mobility.advice(course, &[slope], &samples, &|| true);
            all.unwrap().unwrap()[0].judgement.verdict
        };
        let [on_contour, uphill] = [verdict(across, 0.0), verdict(up, deg(90.0))];
        assert!(uphill > on_contour, "{uphill:?} {on_contour:?}");
        assert!(leg.verdict() >= uphill, "{leg:?}");
        assert!(leg.place.course > deg(45.0) && leg.place.along[0] > 9.0, "{leg:?}");
    }

    /// What is kept off is what legs are judged by: the way has no leg with the verdict no-go, where
    /// the cheapest within limits that allow everything has one.
    #[test]
    fn a_way_that_is_judged_has_no_leg_with_the_verdict_no_go() {
        let (study, samples, tables) =
            uncertain_within(|it| Limits { most_slip_ratio: 1.0, most_no_go: 1.0, ..it });
        // Over a ridge of 17.5°, or around it.
        let raster = ground_of(80, 80, 0.5, |at| {
            let height = deg(17.5).tan() * (4.0 - (at.x - 20.0).abs()).max(0.0);
            height * ((30.0 - at.y) / 6.0).clamp(0.0, 1.0)
        });
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let ends = ends([8.0, 10.0], [32.0, 10.0]);
        let Answer::Route(cheapest) = study.route(&tables, ground, &ends, Objective::Time).unwrap()
        else {
            panic!("there is a way");
        };
        let judged = cheapest.advice(&study.mobility, &samples, &|| true).unwrap().unwrap();
        let is_no_go = |legs: &[Option<JudgedLeg>]| {
            legs.iter().flatten().any(|leg| leg.verdict() == Verdict::NoGo)
        };
        assert!(is_no_go(&judged), "{judged:?}");
        let asked = (ground, &ends);
        let (found, legs) = study
            .judged_route(&tables, asked, Objective::Time, &samples, &|| true)
            .unwrap()
            .unwrap();
        let Answer::Route(around) = found else { panic!("{found:?}") };
        assert!(!is_no_go(&legs), "{legs:?}");
        assert!(around.time > cheapest.time && around.length > cheapest.length);
        let risks = [&cheapest, &around].map(|it| it.risk.as_ref().expect("known ground"));
        let [over, past] = risks.map(|it| it.completion.completed.estimate());
        assert!(past >= over, "{risks:?}");
    }

    /// The profile is the way: its pieces follow each other, rise to its target and have the slopes
    /// of the plane; where a sample ends is where it first is a no-go.
    #[test]
    fn a_profile_has_the_way_piece_by_piece() {
        let (study, samples, tables) = uncertain();
        let rise = deg(17.0).tan();
        let raster = ground_of(40, 60, 0.5, |at| 3.0 + rise * (at.y - 10.0).clamp(0.0, 8.0));
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let line = line(&[[10.0, 4.0], [10.0, 25.0]]);
        let found = study.along(&tables, ground, &line).unwrap();
        let profile = &found.seen.profile;
        assert_eq!(profile.len(), 42);
        for (place, piece) in profile.iter().enumerate() {
            assert!((piece.along - (0.25 + 0.5 * place as f64)).abs() < 1e-9, "{piece:?}");
            let there = piece.ground.expect("it is known");
            let height = 3.0 + rise * (piece.place.y - 10.0).clamp(0.0, 8.0);
            assert!((there.height - height).abs() < 1e-4, "{piece:?}");
        }
        let on_slope = profile[20].ground.expect("it is known");
        assert!((on_slope.slope - deg(17.0)).abs() < 1e-5 && on_slope.course > deg(89.0));
        let level = profile[0].ground.expect("it is known");
        assert_eq!((level.slope, level.probability_no_go), (0.0, 0.0));
        assert!(on_slope.slip_ratio > level.slip_ratio);
        // The median of the samples' own slips, counted one by one.
        let slips = samples.iter().map(|sample| {
            let curve = study.mobility.heading.of_sample(sample).curve_on(deg(90.0)).unwrap();
            let found = curve.at(deg(17.0)).map_or(1.0, |it| it.slip_ratio);
            if found > study.mobility.rule.no_go_slip_ratio { 1.0 } else { found }
        });
        let median = crate::studies::ensemble::Band::of(slips).unwrap().median;
        assert!((on_slope.slip_ratio.unwrap() - median).abs() < 0.01, "{on_slope:?} {median}");
        // Samples end at the foot of the slope, all of them there.
        let risk = found.seen.risk.expect("known ground");
        let completed = risk.completion.completed;
        assert!((completed.estimate() - (1.0 - on_slope.probability_no_go)).abs() < 1e-12);
        assert!(completed.successes < completed.trials, "{risk:?}");
        let end = risk.end.expect("some end");
        assert!((end.along - 6.0).abs() < 1.0 && (end.place.y - 4.0 - end.along).abs() < 1e-9);
    }

    #[test]
    fn lines_that_are_none_are_refused() {
        let through = |places: &[[f64; 2]]| {
            let places = places.iter().map(|it| Vec2::from(*it)).collect();
            Line::through(places, None).unwrap_err().to_string()
        };
        assert!(through(&[]).contains("0 places"));
        assert!(through(&[[1.0, 2.0], [1.0, 2.0]]).contains("no length"));
        assert!(
            through(&[[1.0, 2.0], [f64::NAN, 2.0]]).starts_with("place 2 of the line is x NaN")
        );
        let (study, raster) = (study(), ground_of(30, 30, 0.5, |_| 0.0));
        let ground = Ground::under(&study.mobility.heading.rover, &raster);
        let tables = tables(&study);
        for (places, words) in [
            (
                [[50.0, 2.0], [60.0, 2.0]],
                "the line is not on the map: it lies within x 50.00 to 60.00 m",
            ),
            ([[5.0, 2.0], [1e12, 2.0]], "cells of the map long"),
        ] {
            let error = study.along(&tables, ground, &line(&places)).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
