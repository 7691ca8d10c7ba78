"""A sweep made by hand, with everything that can happen to a point."""

import math

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.results import Reference, Timing
from lightmeter.reports.sweep_results import SCHEMA, CurvePoint, Setting, Standing, Sweep, SweptEffect, ranked

UNIT = "W/sr/m²"


def _standing(ms: float, rmse: float, flip: float) -> Standing:
    metrics = {
        "rmse": Measurement(rmse, 0.9 * rmse, 1.2 * rmse, UNIT, "by hand"),
        "flip": Measurement(flip, unit="", how="by hand", floor=0.01),
    }
    return Standing(Timing(ms, 0.1 * ms, 20), metrics)


def _shadow(resolution: int, filter: str, ms: float, rmse: float, flip: float = 0.1, current: bool = False) -> Setting:
    knobs = {"resolution": resolution, "filter": filter}
    own, frame = _standing(ms, rmse, flip), _standing(ms + 2, rmse + 0.01, flip + 0.1)
    return Setting(knobs, ("resolution", "filter"), current, own, frame)


def make_sweep(complete: bool = True) -> Sweep:
    """A grid with one setting beaten, one perfect, one that failed; and a baking effect with errors of code values."""
    curve = [CurvePoint(n, Timing(4.0 * n, 0.1, 5), _standing(4.0 * n, 0.4 / n**0.5, 0.5).metrics) for n in (1, 4, 16)]
    shadow = SweptEffect(
        "shadow_map",
        ("visibility",),
        "its passes",
        True,
        (
            _shadow(128, "hard", 1.0, 0.30),
            _shadow(128, "pcf3", 1.5, 0.20, current=True),
            _shadow(256, "hard", 2.5, 0.25),
            _shadow(256, "pcf3", 3.0, 0.0),
            _shadow(512, "pcf3", 0.5, math.nan),
        ),
    )
    tone = SweptEffect(
        "narkowicz",
        ("tone",),
        "its passes",
        False,
        tuple(
            Setting(
                {"scale": s},
                () if s == 0.6 else ("scale",),
                s == 0.6,
                _standing(s, s, s),
                _standing(3, 0.1, 0.2),
                bake_ms=100 * s,
            )
            for s in (0.6, 0.8)
        ),
    )
    return Sweep(
        schema=SCHEMA,
        scene="<posts> & co",
        size=(64, 48),
        device={"cpu": "by hand", "llvm": None},
        reference=Reference(64, 8, 1.5, False),
        effects=(ranked(shadow, curve), ranked(tone, curve)),
        path_tracer=tuple(curve),
        notes=("a note",),
        complete=complete,
    )
