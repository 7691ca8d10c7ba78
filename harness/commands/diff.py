"""`lightmeter diff A B`: two images on disk, A tested, B the reference."""

import argparse
import sys
from pathlib import Path

from lightmeter import options
from lightmeter.failures import UsageError

FARTHEST_EXPOSURE = 64.0


def add_options(parser: argparse.ArgumentParser) -> None:
    """The images, how they are to be taken, output."""
    parser.add_argument("tested", metavar="A", help="the tested image: EXR, PNG or HDR")
    parser.add_argument("reference", metavar="B", help="the reference")
    options.add_names(parser, "--metric", "NAME", help="just these (default: all that make sense)")
    parser.add_argument("--ppd", type=options.number, metavar="N", help="pixels per degree, for FLIP (default 67.0)")
    parser.add_argument(
        "--exposure",
        type=options.number,
        metavar="EV",
        help="stops by which scene-linear images are brightened to show",
    )
    parser.add_argument(
        "--transfer",
        metavar="srgb|linear",
        help="how both files' values are encoded (default: srgb, a display image, for PNG; linear for EXR and HDR)",
    )
    parser.add_argument("--layer", metavar="NAME", help="which layer of A, an EXR with several")
    parser.add_argument("--reference-layer", metavar="NAME", help="which layer of B, an EXR with several")
    parser.add_argument("-o", "--output", metavar="DIR", help="where the report goes (default lightmeter-out/diff)")
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Measure, write the report, print the table."""
    if args.transfer not in (None, "srgb", "linear"):
        raise UsageError(f"--transfer: expected srgb or linear, got {args.transfer!r}")
    if args.exposure is not None and abs(args.exposure) > FARTHEST_EXPOSURE:
        raise UsageError(f"--exposure: expected -{FARTHEST_EXPOSURE:g} to {FARTHEST_EXPOSURE:g}, got {args.exposure:g}")
    from lightmeter import difference, image_pair
    from lightmeter.metrics.flip import PIXELS_PER_DEGREE
    from lightmeter.metrics.registry import find_metric
    from lightmeter.report_folder import write_folder

    for name in args.metric:
        find_metric(name)
    ppd = PIXELS_PER_DEGREE if args.ppd is None else args.ppd
    tested = image_pair.read(Path(args.tested), args.transfer, args.layer)
    reference = image_pair.read(Path(args.reference), args.transfer, args.reference_layer)
    images = image_pair.pair(tested, reference, args.exposure)
    results = difference.difference(images, args.metric, ppd)
    folder = options.output_folder(args.output or "lightmeter-out/diff")
    curve = difference.display_curve(images)
    report = write_folder(folder, results, [difference.picture(images, ppd)], curve)
    _show(results, report, args.json)
    return 0


def _show(results, report: Path, as_json: bool) -> None:
    """The table, or results.json itself, on stdout."""
    from lightmeter.reports.results_json import to_json

    if as_json:
        sys.stdout.write(to_json(results))
        print(f"report: {report}", file=sys.stderr)
        return
    from rich.text import Text

    from lightmeter.reports.terminal import metric_table
    from lightmeter.terminal import console

    out = console()
    out.print(Text(f"{results.scene}, {results.size[0]}×{results.size[1]}"))
    out.print(metric_table(dict(results.frame.metrics)))
    if results.nonfinite.frame:
        places = ", ".join(f"({x}, {y})" for x, y in results.nonfinite.where["frame"][:4])
        count = results.nonfinite.frame
        noun = "pixel is" if count == 1 else "pixels are"
        out.print(Text(f"✕ {count} {noun} not finite in the tested image: first at {places}", style="bold red"))
    for item in results.left_out:
        out.print(Text(f"left out: {item.what}: {item.why}"))
    for note in results.notes:
        out.print(Text(f"note: {note}"))
    print(f"report: {report}")
