"""Images of one pixel, and as wide as a texture may be."""

from lightmeter.scenes.stiff.case import StiffCase, room

CASES = {
    "one-by-one": StiffCase("an image of one pixel", room, size=(1, 1)),
    "wide": StiffCase("16,384 × 1 pixels", room, size=(16384, 1)),
    "tall": StiffCase("1 × 16,384 pixels", room, size=(1, 16384)),
}
