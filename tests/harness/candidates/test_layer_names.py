"""Which channels of a file make which layer."""

from pathlib import Path

from lightmeter.candidates.layer_names import LAYERS, find_layers


def names(*channels: str) -> list[tuple[str, tuple[str, ...]]]:
    return [(layer.name, layer.channels) for layer in find_layers(channels)[0]]


def test_three_channels_are_a_layer_in_their_order():
    assert names("visibility.0.B", "visibility.0.G", "visibility.0.R") == [
        ("visibility.0", ("visibility.0.R", "visibility.0.G", "visibility.0.B"))
    ]
    assert names("normal.X", "normal.Y", "normal.Z") == [("normal", ("normal.X", "normal.Y", "normal.Z"))]


def test_one_channel_is_a_layer_with_or_without_a_suffix():
    assert names("depth") == [("depth", ("depth",))]
    assert names("depth.Z") == [("depth", ("depth.Z",))]
    assert names("Z") == [("depth", ("Z",))]
    assert names("visibility.3") == [("visibility.3", ("visibility.3",))]
    assert names("visibility.3.Y") == [("visibility.3", ("visibility.3.Y",))]


def test_a_lights_number_is_read():
    (layer,), _ = find_layers(["direct.12.R", "direct.12.G", "direct.12.B"])
    assert (layer.kind, layer.light) == ("direct.N", 12)


def test_the_image_is_no_layer_and_what_is_not_known_is_told():
    layers, others = find_layers(["R", "G", "B", "A", "albedo.R", "albedo.G", "albedo.B", "visibility.0.R"])
    assert [layer.name for layer in layers] == ["visibility.0"]
    assert others == ("albedo",)


def test_a_layer_that_lacks_a_channel_is_not_guessed_at():
    assert find_layers(["direct.R", "direct.G"]) == ((), ("direct",))


def test_every_layer_is_in_the_docs():
    docs = (Path(__file__).parents[3] / "docs" / "candidates.md").read_text(encoding="utf-8")
    for name, layer in LAYERS.items():
        assert f"| `{name}` | {layer.meaning} |" in docs
