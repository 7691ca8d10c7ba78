"""What was found of one thing that lightmeter needs."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """One thing that lightmeter needs: what was found, and, where it does not do, what to run."""

    name: str
    value: str
    ok: bool = True
    note: str = ""
    remedy: str = ""
    packages: tuple[str, ...] = ()
    """System packages that `remedy` installs, by the names this distribution gives them."""
