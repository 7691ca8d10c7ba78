"""Numbers as people read them: as many digits as the interval supports, and no more."""

import math

from lightmeter.metrics.measurement import Measurement

_NEARLY = 1.2
"""An interval whose wider side is below this many times its half-width is printed with ±."""
MINUS = "\N{MINUS SIGN}"


def show_number(value: float, digits: int = 3) -> str:
    """`value` with `digits` significant digits; "NaN", "∞" and "−∞" where it is not finite."""
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "∞" if value > 0 else f"{MINUS}∞"
    if value == 0:
        return "0"
    return _decimals(value, digits - 1 - math.floor(math.log10(abs(value))))


def show_value(measurement: Measurement, digits: int = 3) -> str:
    """The value alone, to two digits of its interval's half-width (at most six significant digits)."""
    half = half_width(measurement)
    if not math.isfinite(measurement.value):
        return show_number(measurement.value)
    if half is None or half == 0 or not math.isfinite(half):
        return show_number(measurement.value, digits)
    return _decimals(measurement.value, _places(measurement.value, half))


def show_interval(measurement: Measurement) -> str:
    """The interval alone: "± 0.00021" where nearly symmetric about the value, else "0.0119 … 0.0131"; "" for none.

    A ± states the wider side, so that it never claims more than the interval does.
    A bound on a metric that noise biases may leave the value outside: it is about the value without that bias.
    """
    low, high, value = measurement.low, measurement.high, measurement.value
    if low is None or high is None or not math.isfinite(value):
        return ""
    half = half_width(measurement)
    if half is None or not math.isfinite(half):
        return f"{show_number(low)} … {show_number(high)}"
    wider = max(high - value, value - low)
    symmetric = wider <= max(_NEARLY * half, half + 1e-5 * abs(value))
    if half == 0:
        return "± 0" if symmetric else f"{show_number(low, 6)} … {show_number(high, 6)}"
    places = _places(value, half)
    if symmetric:
        return f"± {_decimals(wider, places)}"
    return f"{_decimals(low, places)} … {_decimals(high, places)}"


def show_measurement(measurement: Measurement) -> str:
    """Value, interval and unit in one line: "0.01234 ± 0.00021 W/sr/m²"."""
    parts = [show_value(measurement), show_interval(measurement), measurement.unit]
    if "…" in parts[1]:
        parts[1] = f"({parts[1]})"
    return " ".join(part for part in parts if part)


def half_width(measurement: Measurement) -> float | None:
    """Half the interval's width, None where there is no interval, 0 where six digits cannot show it (rounding)."""
    if measurement.low is None or measurement.high is None:
        return None
    half = (measurement.high - measurement.low) / 2
    return 0.0 if half < 5e-6 * abs(measurement.value) else half


def _places(value: float, half: float) -> int:
    """Decimal places that show two digits of `half`, and at most six significant digits of `value`."""
    places = 1 - math.floor(math.log10(half))
    if value:
        places = min(places, 5 - math.floor(math.log10(abs(value))))
    return places


def _decimals(value: float, places: int) -> str:
    """`value` rounded at 10^-places; with a power of ten where plain digits would be a row of zeros."""
    if value and (abs(value) >= 1e6 or (abs(value) < 1e-4 and places > 7)):
        exponent = math.floor(math.log10(abs(value)))
        if places + exponent < 0:
            return "0"
        mantissa = value / 10.0**exponent
        return f"{mantissa:.{min(5, places + exponent)}f}e{exponent}".replace("-", MINUS)
    shown = f"{round(value, places):.{max(0, places)}f}"
    if float(shown) == 0:
        shown = shown.lstrip("-")
    return shown.replace("-", MINUS)
