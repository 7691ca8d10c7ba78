"""What takes no part in a frame though it was asked for, or though the scene needs it: a sentence for each."""

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, Plan


def unheard(plan: Plan, choice: Choice | None) -> tuple[str, ...]:
    """A sentence for each effect that was asked for, or whose knobs were set, and that takes no part."""
    if choice is None:
        return ()
    named = dict.fromkeys((*choice.use, *choice.only, *choice.settings))
    absent = [name for name in named if name not in plan.effects and name not in choice.without]
    return tuple(
        f"{name} {'is asked for' if name in (*choice.use, *choice.only) else 'has knobs set'}, and takes no part: "
        f"{plan.why_absent(name)}"
        for name in absent
    )


def remedies(plan: Plan) -> tuple[str, ...]:
    """A sentence for each term that no effect gives and that some would give if they were asked for."""
    known = effects()
    able = {item.what: known[item.what] for item in plan.left_out if item.why.endswith(f"--use {item.what}")}
    found = {term: [name for name, effect in able.items() if term in effect.terms] for term in plan.not_approximated}
    return tuple(
        f"Nothing gives {term}: {' or '.join(f'--use {name}' for name in names)} does"
        for term, names in found.items()
        if names
    )
