//! Carries the motion through time: the one place that knows the solver's library.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;

use diffsol::{
    BdfState, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeSolverMethod, OdeSolverProblem,
    OdeSolverState, Vector,
};

use super::equations::{Equations, Rates};
use crate::units::Vec2;
use crate::vehicle::{Acceleration, RoverState};

/// How many numbers move: pose, velocities, and the two energies.
const SIZE: usize = 8;

/// What is integrated: the rover's state, the motors' work and the work on the soil [J].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) state: RoverState,
    pub(super) motors: f64,
    pub(super) soil: f64,
}

impl Point {
    fn from_array(y: &[f64]) -> Self {
        Self {
            state: RoverState {
                position: Vec2::new(y[0], y[1]),
                yaw: y[2],
                velocity: Vec2::new(y[3], y[4]),
                yaw_rate: y[5],
            },
            motors: y[6],
            soil: y[7],
        }
    }

    fn to_array(self) -> [f64; SIZE] {
        let RoverState { position, yaw, velocity, yaw_rate } = self.state;
        [position.x, position.y, yaw, velocity.x, velocity.y, yaw_rate, self.motors, self.soil]
    }
}

impl Rates {
    fn to_array(self) -> [f64; SIZE] {
        let Acceleration { velocity_rate, yaw_acceleration } = self.acceleration;
        [
            self.velocity_slope.x,
            self.velocity_slope.y,
            self.yaw_rate,
            velocity_rate.x,
            velocity_rate.y,
            yaw_acceleration,
            self.motor_power,
            self.soil_power,
        ]
    }
}

/// Why time did not go on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stalled {
    /// The last time that was reached [s].
    pub(super) time: f64,
    /// What the solver said.
    pub(super) reason: String,
}

/// Receives the point at each time asked for, and says whether to go on.
pub(super) type OnSample<'a> = dyn FnMut(f64, &Point) -> ControlFlow<()> + 'a;

/// Which components the rates depend on: yaw and the velocities. The slope is the same everywhere.
const COUPLED: std::ops::Range<usize> = 2..6;

/// Smallest error that a step may leave, besides the relative tolerance times the value, over that
/// tolerance: lengths [m], angles [rad] and speeds [m/s] far below what a rover notices, and
/// energies [J] to match.
const SMALL: [f64; SIZE] = [1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-2, 1e-2];

/// What an implicit integration knows at its end: step size, order and the points behind it. One
/// that goes on from there with other rim speeds need not feel its way from a tiny step again.
#[derive(Clone, Default)]
pub(super) struct History(Option<BdfState<NalgebraVec<f64>, NalgebraMat<f64>>>);

impl History {
    /// Forgets it: what comes is no continuation.
    pub(super) fn clear(&mut self) {
        self.0 = None;
    }

    /// That of the motion which ended at a point, if it did.
    fn take(&mut self, point: &Point, time: f64) -> Option<BdfState<NalgebraVec<f64>>> {
        let state = self.0.take()?;
        let reached = state.as_ref();
        let there = Point::from_array(&reached.y.clone_as_vec());
        (reached.t == time && there.state == point.state).then_some(state)
    }
}

/// Implicit integration with steps of its own (BDF), from `start` through all `times`.
///
/// * `history`: of the motion so far, and afterwards of this one
///
/// # Errors
/// [`Stalled`] where no step is small enough.
pub(super) fn bdf(
    equations: &Equations<'_>,
    start: &Point,
    start_time: f64,
    times: &[f64],
    tolerance: f64,
    history: &mut History,
    on_sample: &mut OnSample<'_>,
) -> Result<(), Stalled> {
    type Matrix = NalgebraMat<f64>;
    let reached = Cell::new(start_time);
    let stalled =
        |reason: diffsol::DiffsolError| Stalled { time: reached.get(), reason: reason.to_string() };
    let base = RefCell::new(([f64::NAN; SIZE], [f64::NAN; SIZE]));
    let first = start.to_array();
    let mut problem: OdeSolverProblem<_> = OdeBuilder::<Matrix>::new()
        .t0(start_time)
        .h0(FIRST_STEP)
        .rtol(tolerance)
        .atol(SMALL.map(|size| size * tolerance))
        .rhs_implicit(
            |y: &[f64], _: &[f64], _: f64, rates: &mut [f64]| {
                rates.copy_from_slice(&rates_at(equations, y));
                let mut base = base.borrow_mut();
                base.0.copy_from_slice(y);
                base.1.copy_from_slice(rates);
            },
            |y: &[f64], _: &[f64], _: f64, direction: &[f64], product: &mut [f64]| {
                // The solver asks for one column after the other.
                if direction[0] != 0.0 {
                    equations.count(|work| work.jacobians += 1);
                }
                if base.borrow().0 != *y {
                    let rates = rates_at(equations, y);
                    let mut base = base.borrow_mut();
                    base.0.copy_from_slice(y);
                    base.1 = rates;
                }
                directional_derivative(equations, y, &base.borrow().1, direction, product);
            },
        )
        .init(|_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&first), SIZE)
        .build()
        .map_err(stalled)?;
    // They are counted over the whole run, and each only shortens a step: that no step is short
    // enough is found by the step's own limit.
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    let mut solver = match history.take(start, start_time) {
        Some(state) => problem.bdf_solver::<NalgebraLU<f64>>(state),
        None => problem.bdf::<NalgebraLU<f64>>(),
    }
    .map_err(stalled)?;
    // A continued motion counts its work from its own start on; the books may have moved meanwhile.
    let counted = Point::from_array(&solver.state().y.clone_as_vec());
    let (motors, soil) = (start.motors - counted.motors, start.soil - counted.soil);
    if let Some(&last) = times.last() {
        solver.set_stop_time(last).map_err(stalled)?;
    }
    for &time in times {
        let mut steps = 0;
        while solver.state().t < time {
            solver.step().map_err(stalled)?;
            equations.count(|work| work.steps += 1);
            reached.set(solver.state().t);
            steps += 1;
            if steps > MOST_STEPS {
                let reason = format!("{MOST_STEPS} steps did not reach the next sample");
                return Err(Stalled { time: reached.get(), reason });
            }
        }
        let y = solver.interpolate(time).map_err(stalled)?;
        let mut point = Point::from_array(&y.clone_as_vec());
        point.motors += motors;
        point.soil += soil;
        if on_sample(time, &point).is_break() {
            return Ok(());
        }
    }
    history.0 = Some(solver.into_state());
    Ok(())
}

/// First step [s]: well within the milliseconds in which slip settles.
const FIRST_STEP: f64 = 1e-4;

/// More steps than this between two samples mean that the motion chatters.
const MOST_STEPS: u32 = 100_000;

fn rates_at(equations: &Equations<'_>, y: &[f64]) -> [f64; SIZE] {
    // A state without rates is one the integrator must step back from; it does so at NaN.
    let evaluation = equations.attempt(&Point::from_array(y).state);
    evaluation.map_or([f64::NAN; SIZE], |evaluation| evaluation.rates.to_array())
}

/// Derivative of the rates along a direction, by a forward difference.
fn directional_derivative(
    equations: &Equations<'_>,
    y: &[f64],
    rates: &[f64; SIZE],
    direction: &[f64],
    product: &mut [f64],
) {
    product.fill(0.0);
    let size = direction[COUPLED].iter().fold(0.0, |size: f64, part| size.max(part.abs()));
    if size == 0.0 {
        return;
    }
    /// Step of the difference [rad, m/s, rad/s]: forces are exact to 1e-12, speeds are a few
    /// hundredths.
    const STEP: f64 = 1e-8;
    let step = STEP / size;
    let mut beside = [0.0; SIZE];
    for (index, value) in beside.iter_mut().enumerate() {
        *value = y[index] + if COUPLED.contains(&index) { step * direction[index] } else { 0.0 };
    }
    for ((product, there), here) in product.iter_mut().zip(rates_at(equations, &beside)).zip(rates)
    {
        *product = (there - here) / step;
    }
}

/// The classical Runge-Kutta method with a fixed step, shortened to meet each of the `times`.
///
/// # Errors
/// [`Stalled`] where a step leads to a state without rates.
pub(super) fn rk4(
    equations: &Equations<'_>,
    start: &Point,
    start_time: f64,
    times: &[f64],
    step: f64,
    on_sample: &mut OnSample<'_>,
) -> Result<(), Stalled> {
    let mut y = start.to_array();
    let mut now = start_time;
    for &time in times {
        let mut left = ((time - now) / step).ceil().max(1.0);
        let h = (time - now) / left;
        while left > 0.0 {
            left -= 1.0;
            equations.count(|work| work.steps += 1);
            let k_1 = rates_at(equations, &y);
            let k_2 = rates_at(equations, &moved(&y, &k_1, 0.5 * h));
            let k_3 = rates_at(equations, &moved(&y, &k_2, 0.5 * h));
            let k_4 = rates_at(equations, &moved(&y, &k_3, h));
            for i in 0..SIZE {
                y[i] += h / 6.0 * (k_1[i] + 2.0 * k_2[i] + 2.0 * k_3[i] + k_4[i]);
            }
            if !y.iter().all(|part| part.is_finite()) {
                return Err(Stalled { time: now, reason: "the step led nowhere".into() });
            }
        }
        now = time;
        if on_sample(time, &Point::from_array(&y)).is_break() {
            break;
        }
    }
    Ok(())
}

fn moved(y: &[f64; SIZE], rates: &[f64; SIZE], span: f64) -> [f64; SIZE] {
    std::array::from_fn(|i| y[i] + span * rates[i])
}
