"""A user's script, for a strict type checker: what is not typed as it is used here is a fault."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import grouser as gr


def deepest(soils: list[gr.Soil], load_n: float) -> float:
    wheels: gr.Settled = gr.settle(soils, gr.Wheel("hakuto"), load_n=load_n, slip_ratio=0.2)
    sinkage: NDArray[np.float64] = wheels.sinkage_mm
    return float(sinkage.max())


def downhill_m(slope_deg: float) -> float:
    run: gr.Trajectory = gr.simulate(gr.Scenario(slope_deg=slope_deg), duration_s=5.0)
    y_m: NDArray[np.float64] = run.y_m
    return float(-y_m[-1]) if run.outcome == "completed" else float("nan")


def fitted(file: Path) -> gr.Soil:
    found: gr.Calibration = gr.calibrate(
        file, "toyoura", "hakuto", fit={"shear.longitudinal_m": (0.01, 0.1), "cohesion_kpa": None}
    )
    best: dict[str, float] = found.best
    samples: NDArray[np.float64] | None = found.samples
    print(best, None if samples is None else samples.shape, found.outcome, found.message)
    return found.soil


def stepped(scenarios: list[gr.Scenario]) -> NDArray[np.float64]:
    rover: gr.Run = gr.Run(scenarios[0], commands="rim_speed_m_s")
    slip_ratio: NDArray[np.float64] = rover.wheel["slip_ratio"]
    state: NDArray[np.float64] = rover.step(0.06 + 0.0 * slip_ratio, 0.1)
    many: gr.RunBatch = gr.RunBatch(scenarios)
    many.reset(seed=1)
    stuck: bool = rover.outcome == "immobilised"
    return state if stuck else many.step(np.full((len(many), 4), 0.5), 0.1)[0]


def stopped_by(mission: gr.Mission) -> dict[str, str | None]:
    found: gr.DrivenMission = gr.mission(mission, simulation="quasi-steady")
    distance: NDArray[np.float64] = found.legs.distance_m
    print(found.final["x_m"], distance.sum(), found.trajectory.yaw_deg[-1], mission.slope_deg)
    return {name: way.legs.stopped_by[-1] for name, way in found.alternatives.items()}


def swept(cohesions_kpa: list[float]) -> NDArray[np.float64]:
    vary = {"soil.cohesion_kpa": cohesions_kpa}
    headings: gr.Sweep = gr.heading(slope_deg=[5.0], vary=vary, nominal=True)
    maps: gr.Sweep = gr.heading_map(slope_deg=[5.0], course_deg=[0.0], vary=vary, outside="nan")
    speeds: gr.Sweep = gr.wheel_speeds(slope_deg=[5.0], vary={}, rover=["hakuto", "hakuto-steered"])
    stand: gr.Sweep = gr.wheel_test(wheel=["hakuto"], load_n=17.0, slip_ratio=0.2, vary=vary)
    models: gr.ByModel[gr.Sweep] = gr.heading(model="all", vary={}, slope_deg=[5.0], nominal=True)
    print(maps["yaw_deg"], speeds.limits.limit_slope_deg, stand.shape, len(models), headings.status)
    yaws: NDArray[np.float64] = headings["yaw_deg"]
    return yaws


def main() -> None:
    site: gr.Site = gr.Site("toyoura", slope_deg=10.0).replace(gravity_m_s2=gr.MOON_GRAVITY)
    soil: gr.Soil = gr.Soil("toyoura").replace(cohesion_kpa=0.5)
    level: gr.Headings = gr.heading(slope_deg=[5.0, 10.0], samples=4, rule={"go_slip_ratio": 0.2})
    stuck: NDArray[np.float64] | None = level.probability_stuck
    if level.band is not None and level.verdict is not None:
        print(level.verdict[0], level.band.yaw_deg_p97_5 - level.yaw_deg, stuck)
    speeds: gr.WheelSpeeds = gr.wheel_speeds(slope_deg=[5.0], most_speed_ratio=1.5)
    ratios: NDArray[np.float64] = speeds.speed_ratio
    steepest: NDArray[np.float64] = speeds.limits.limit_slope_deg
    models: gr.ByModel[gr.WheelSpeeds] = gr.wheel_speeds(slope_deg=[], model="all")
    print(ratios[0, speeds.wheels.index("by-side")], steepest.max(), len(models))
    ends: gr.Rollout = gr.rollout([gr.Scenario(site=site)], slope_deg=[[5.0], [10.0]])
    test: gr.SimulatedWheelTest = gr.wheel_test(load_n=20, slip_ratio=[0.1, 0.4], trials=3)
    exact: gr.WheelTest = gr.wheel_test(load_n=20, slip_ratio=[0.1, 0.4])
    print(test.drawbar_pull_n.mean(axis=-1) - exact.wheels.drawbar_pull_n)
    limit: float | None = level.limit_slope_deg
    print(stopped_by(gr.Mission("two-steps-forward")))
    print(swept([0.1, 0.5]))
    try:
        print(deepest([soil], 17.0), downhill_m(10.0), limit, ends.outcome[0], stepped([gr.Scenario()]))
    except gr.ParameterError as error:
        print(error.name, error.value, error.expected)


main()
