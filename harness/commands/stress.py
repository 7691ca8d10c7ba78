"""`lightmeter stress [EFFECT…]`: where shading functions lose digits, or scenes break, on extreme inputs."""

import argparse
import sys
from shlex import quote

from lightmeter import options
from lightmeter.failures import UsageError
from lightmeter.progress import progress_bar


def add_options(parser: argparse.ArgumentParser) -> None:
    """Effects, or one function at one input; output."""
    parser.add_argument("effects", nargs="*", metavar="EFFECT", help="functions of these effects (default: all)")
    parser.add_argument(
        "--function", metavar="NAME", help="just this function: OWNER/FUNCTION as the table calls it, or FUNCTION"
    )
    parser.add_argument(
        "--input",
        nargs="+",
        action="extend",
        metavar="ARG=X,Y…",
        help="evaluate --function at this input: every argument, its components parted by commas",
    )
    parser.add_argument(
        "--law",
        choices=("reciprocity", "albedo"),
        help="hold this law of a BRDF at --input, in place of its digits: reciprocity, or the albedo of a surface, "
        "whose --input is the function's parameters and n_dot_v (and turn, of a grain)",
    )
    parser.add_argument(
        "--scenes",
        nargs="*",
        action="extend",
        metavar="SCENE",
        help="stiff scenes in place of functions: these, or all; both sides of each are rendered and compared; a scene "
        "of your own (.toml, .glb, .gltf, a library name) beside its copies of other sizes and in another place",
    )
    options.add_choice(parser)
    parser.add_argument("--seed", type=options.whole, default=0, metavar="N", help="names the inputs (default 0)")
    parser.add_argument("-o", "--output", metavar="DIR", help="where the page goes (default lightmeter-out/stress)")
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Stress, write the page, print the table; or evaluate one input."""
    if not 0 <= args.seed < 1 << 32:
        raise UsageError(f"--seed: expected 0 to {(1 << 32) - 1}, got {args.seed}")
    if args.input and not args.function:
        raise UsageError("--input: name the function with --function")
    if args.law and not args.input:
        raise UsageError("--law: say where to hold it, with --function and --input")
    if args.scenes is not None:
        if args.effects or args.function:
            raise UsageError("--scenes: it takes the place of effects and functions; leave them out")
        return _scenes(args)
    if words := _choice_words(args):
        raise UsageError(f"{words.split()[0]}: it chooses what is drawn of scenes; give it with --scenes")
    from lightmeter.realtime.stress.naming import named, of_effects

    chosen = of_effects(args.effects)
    if args.function:
        chosen = named(args.function, chosen)
    if not chosen:
        raise UsageError(f"{', '.join(args.effects)}: no function of arithmetic, nothing to stress")
    if args.input:
        if len(chosen) > 1:
            raise UsageError(
                f"--input: several functions are called {args.function!r}: name one of "
                f"{', '.join(subject.name for subject in chosen)}"
            )
        return _law_at_input(chosen[0], args) if args.law else _at_input(chosen[0], args)
    return _all(chosen, args)


def _all(chosen: list, args: argparse.Namespace) -> int:
    from lightmeter.device import fingerprint
    from lightmeter.realtime.device import Device
    from lightmeter.realtime.stress.laws import hold_laws
    from lightmeter.realtime.stress.search import Stress
    from lightmeter.reports.results_json import to_json
    from lightmeter.reports.stress_page import write_stress
    from lightmeter.reports.stress_results import SCHEMA, StressResults

    folder = options.output_folder(args.output or "lightmeter-out/stress")
    device = Device()
    functions, laws = [], {}
    with progress_bar() as report:
        for done, subject in enumerate(chosen):
            report("functions", done, len(chosen))
            functions.append(Stress(device, subject.name, subject.twin, subject.folder, args.seed).run())
            if held := hold_laws(device, subject, args.seed):
                laws[subject.name] = held
    results = StressResults(SCHEMA, args.seed, fingerprint(device.renderer, device.version), functions, laws)
    page = write_stress(folder, results)
    if args.json:
        sys.stdout.write(to_json(results))
        print(f"report: {page}", file=sys.stderr)
        return 0
    from lightmeter.reports.stress_laws import law_table, violations
    from lightmeter.reports.stress_table import fault_lines, stress_tables
    from lightmeter.terminal import console

    console().print(stress_tables(results))
    if laws:
        console().print(law_table(laws))
    for line in fault_lines(results):  # whole, so that the command can be copied
        print(line)
    for name, held in laws.items():
        for found in violations(name, held):
            print(f"✕ {found.function}, {found.what}: {found.command}")
    print(f"report: {page}")
    return 0


def _scenes(args: argparse.Namespace) -> int:
    from lightmeter.scenes.stiff import CASES, chosen

    cases, words = chosen(args.scenes), options.words(args)
    folder = options.output_folder(args.output or "lightmeter-out/stress")

    from lightmeter.planning import this_device
    from lightmeter.realtime.graph import Choice
    from lightmeter.reports.results_json import to_json
    from lightmeter.reports.stiff_page import write_stiff
    from lightmeter.reports.stiff_results import SCHEMA, StiffResults
    from lightmeter.stiff_scenes import BATCHES, SPP, examine

    choice = Choice(words.only, words.without, words.use, words.settings)
    again = _choice_words(args) + (f" --seed {args.seed}" if args.seed else "")
    findings, pictures = [], {}
    with progress_bar() as report:
        for found in examine(cases, {**CASES, **cases}, args.seed, choice, again, pictures.__setitem__):
            findings.append(found)
            report("stiff scenes", len(findings), len(cases))
    results = StiffResults(SCHEMA, args.seed, SPP, BATCHES, this_device(), findings)
    page = write_stiff(folder, results, pictures)
    if args.json:
        sys.stdout.write(to_json(results))
        print(f"report: {page}", file=sys.stderr)
        return 0
    from lightmeter.reports.stiff_table import stiff_table
    from lightmeter.terminal import console

    console().print(stiff_table(findings))
    print(f"report: {page}")
    return 0


def _choice_words(args: argparse.Namespace) -> str:
    """The choice of effects as it was written, to be written again; "" for none."""
    lists = {name: getattr(args, name) for name in ("only", "without", "use")}
    named = [f" --{name} {quote(','.join(value))}" for name, value in lists.items() if value]
    return "".join([*named, *(f" --set {quote(text)}" for text in args.set)])


def _at_input(subject, args: argparse.Namespace) -> int:
    from lightmeter.realtime.device import Device
    from lightmeter.realtime.stress.search import Stress
    from lightmeter.reports.results_json import to_json
    from lightmeter.stress_input import parse

    stress = Stress(Device(), subject.name, subject.twin, subject.folder, args.seed)
    examples = stress.at(parse(args.input, stress.design.arguments))
    if args.json:
        sys.stdout.write(to_json(examples))
        return 0
    from lightmeter.reports.stress_table import input_table
    from lightmeter.terminal import console

    console().print(input_table(subject.name, examples))
    return 0


def _law_at_input(subject, args: argparse.Namespace) -> int:
    from lightmeter.realtime.device import Device
    from lightmeter.realtime.stress.laws import ALBEDO, law
    from lightmeter.reports.results_json import to_json
    from lightmeter.reports.stress_laws import at_input
    from lightmeter.stress_input import parse

    brdf = subject.twin.brdf
    if brdf is None or (args.law == ALBEDO and not brdf.whole):
        what = "is no BRDF" if brdf is None else "is a factor of a BRDF, which has no albedo"
        raise UsageError(f"--law {args.law}: {subject.name} {what}, as its twin in {subject.twin.file} declares it")
    held = law(args.law, Device(), subject, args.seed)
    inputs = parse(args.input, held.arguments)
    if not held.defined(inputs).all():
        raise UsageError(f"--law {args.law}: {held.needs}")
    extreme = held.at(inputs)
    if args.json:
        sys.stdout.write(to_json(extreme))
    else:
        print(at_input(args.law, extreme))
    return 0
