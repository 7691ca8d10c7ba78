"""lightmeter.baseline.json: what regressions are measured against. It holds no date, and its keys are sorted.

A regression asks whether θ ≤ (1 + r) θ₀, with both sides uncertain. Half of the limit's error is spent on the interval
of θ₀ when it is stored, half on that of θ now: PASS when high ≤ (1 + r) low₀, FAIL when low > (1 + r) high₀. That both
runs may have drawn the same batches does not matter to this (Boole).

On another device r is widened. Software rasterisers differ in the last bits of quotients and roots, which moves a
radiance by less than 10⁻³ and now and then flips a comparison with a shadow map's texel: `SAME_KIND` = 0.5 % of the
error. Graphics processors filter textures with weights of 8 bits and choose mipmaps by rules of their own, which moves
a filtered value by up to 1/256 of its contrast each: `OTHER_KIND` = 2 %. Both are round figures above what these
causes can do to a sound image, not measurements.
"""

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

from lightmeter.device import Fingerprint
from lightmeter.failures import UsageError
from lightmeter.metrics.sequential import Bound
from lightmeter.reports.one_step import write_text

SCHEMA = 1
SAME_KIND, OTHER_KIND = 0.005, 0.02
_DEVICE = ("cpu", "cores", "gl_renderer", "gl_version", "gl_software")
_VERSIONS = ("lightmeter", "mitsuba", "drjit")


@dataclass(frozen=True)
class Stored:
    """One stored value.

    Attributes:
        value, low, high: of the metric; the interval misses the truth at either end with probability `error`.
        samples: per pixel, that it took.
        device: digest of the device.
        versions: of what made it.
    """

    value: float
    low: float
    high: float
    error: float
    samples: int
    device: str
    versions: dict[str, str | None]


@dataclass
class Baseline:
    """The stored values by their keys, and the devices that they speak of."""

    values: dict[str, Stored]
    devices: dict[str, Fingerprint]

    def put(self, key: str, value: Stored, device: Fingerprint) -> None:
        """Store a value in place of what was there."""
        self.values[key] = value
        self.devices[value.device] = {name: device[name] for name in _DEVICE}

    def write(self, path: Path) -> None:
        """Write it in one step."""
        used = {value.device for value in self.values.values()}
        document = {
            "schema": SCHEMA,
            "devices": {name: found for name, found in self.devices.items() if name in used},
            "values": {key: asdict(value) for key, value in self.values.items()},
        }
        write_text(path, json.dumps(document, indent=2, sort_keys=True, ensure_ascii=False) + "\n")

    def tolerance(self, stored: Stored, here: str, device: Fingerprint) -> tuple[float, str]:
        """What is added to a regression on this device, and the rule in words; 0 and "" on the baseline's own."""
        if stored.device == here:
            return 0.0, ""
        there = self.devices.get(stored.device, {})
        alike = there.get("gl_software") is True and device["gl_software"] is True
        more = SAME_KIND if alike else OTHER_KIND
        kind = "two software rasterisers" if alike else "two kinds of device"
        return more, f"the baseline is from device {stored.device}, this is {here}: {100 * more:g} % more for {kind}"


def versions_of(device: Fingerprint) -> dict[str, str | None]:
    """The versions that a stored value names."""
    return {name: None if device[name] is None else str(device[name]) for name in _VERSIONS}


def read_baseline(path: Path) -> Baseline:
    """The stored values; none where there is no file.

    Raises:
        UsageError: it is not what `lightmeter gate --update` writes.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return Baseline({}, {})
    except (IsADirectoryError, UnicodeDecodeError):
        raise UsageError(f"{path}: expected a baseline that `lightmeter gate --update` wrote") from None
    try:
        document = json.loads(text)
        if document["schema"] != SCHEMA:
            raise UsageError(
                f"{path}: expected schema {SCHEMA}, got {document['schema']!r}; write it again with `lightmeter gate "
                "--update`"
            )
        values = {key: _stored(entry) for key, entry in document["values"].items()}
        return Baseline(values, dict(document["devices"]))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        if isinstance(error, UsageError):
            raise
        raise UsageError(
            f"{path}: expected a baseline that `lightmeter gate --update` wrote, got {type(error).__name__}: {error}"
        ) from None


def _stored(entry: dict) -> Stored:
    found = Stored(**entry)
    numbers = (found.value, found.low, found.high, found.error)
    if not all(isinstance(n, int | float) and math.isfinite(n) for n in numbers) or found.low > found.high:
        raise ValueError(f"a stored value needs finite numbers with low <= high, got {entry}")
    return found


def regression_bound(stored: Stored, regression: float, larger_is_worse: bool, magnitude: bool) -> Bound:
    """The bound that a stored value gives, as uncertain as it is."""
    low, high = stored.low, stored.high
    if magnitude:
        low, high = (0.0 if low <= 0 <= high else min(abs(low), abs(high))), max(abs(low), abs(high))
    if larger_is_worse:
        return Bound(max(low, 0.0) * (1 + regression), max(high, 0.0) * (1 + regression), True, magnitude)
    return Bound(high * (1 - regression), low * (1 - regression), False, magnitude)
