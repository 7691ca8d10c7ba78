"""Which object holds the error, as the page shows it."""

import math
from collections.abc import Sequence
from typing import Any

from lightmeter.reports.cells import measured, named
from lightmeter.reports.metric_words import present
from lightmeter.reports.percentages import in_percent
from lightmeter.reports.results import ObjectError
from lightmeter.reports.signed_bars import Axis
from lightmeter.reports.significant import show_number

_COLUMNS = ("rmse", "bias", "flip")
_MOST = 20


def object_content(objects: Sequence[ObjectError]) -> dict[str, Any] | None:
    """The objects by their share of the squared error, the largest first; those after the 20th in one row."""
    if not objects:
        return None
    ordered = by_share(objects)
    listed, others = ordered[:_MOST], ordered[_MOST:]
    columns = present(_COLUMNS, [name for one in listed for name in one.metrics])
    axis = Axis.spanning(one.share for one in listed)
    return {
        "columns": [named(name) for name in columns],
        "rows": [_row(one, columns, axis) for one in listed],
        "others": _summed(others) if others else None,
    }


def by_share(objects: Sequence[ObjectError]) -> list[ObjectError]:
    """The largest share first; before all others what holds a metric that is not a number, which is a failure.

    Shares that are not numbers come last: the frame has no error to share out, or is itself not a number.
    """

    def key(one: ObjectError) -> tuple[bool, float]:
        failed = any(math.isnan(metric.value) for metric in one.metrics.values())
        return not failed, math.inf if math.isnan(one.share.value) else -one.share.value

    return sorted(objects, key=key)


def _row(one: ObjectError, columns: Sequence[str], axis: Axis) -> dict[str, Any]:
    return {
        "name": one.name,
        "material": one.material,
        "pixels": f"{one.pixels:,}",
        "cells": [measured(one.metrics[name]) if name in one.metrics else None for name in columns],
        "share": None if math.isnan(one.share.value) else measured(in_percent(one.share)),
        "bar": axis.bar(one.share),
    }


def _summed(others: Sequence[ObjectError]) -> dict[str, str]:
    """The rest in one row, without an interval: how their errors go together is not known."""
    share = sum(one.share.value for one in others)
    return {
        "count": str(len(others)),
        "pixels": f"{sum(one.pixels for one in others):,}",
        "share": "–" if math.isnan(share) else f"{show_number(100 * share, 2)} %",
    }
