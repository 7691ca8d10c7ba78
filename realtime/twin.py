"""A GLSL function beside its float64 twin, declared so that a test can hold one against the other.

An effect's folder declares `TWINS` in its `twin.py`; those of the shared shaders are in `shared_twins.py`. The test
(`tests/realtime/test_glsl_twins.py`) finds them: a new effect's twins are held without touching it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

SIZES = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "mat4": 16, "int": 1, "bool": 1}

Draw = Callable[[np.random.Generator, int], np.ndarray]
"""Random inputs: n lanes as (n,) for a scalar, (components, n) otherwise."""


@dataclass(frozen=True)
class Argument:
    """One argument of a GLSL function.

    Attributes:
        name: as in the GLSL.
        type: GLSL's: float, vec2 … vec4, mat4 (column by column), int, bool.
        draw: random inputs over its domain.
        boundary: values that random draws would miss: the ends of clamps, zeros, where a branch changes.
        out: whether the function writes it; then it is compared too and needs no inputs.
        kind: what it stands for, where its extremes (`stress/kinds.py`) cannot be told by its name and draw.
    """

    name: str
    type: str
    draw: Draw | None = None
    boundary: Sequence[float | Sequence[float]] = ()
    out: bool = False
    kind: str = ""

    @property
    def size(self) -> int:
        """How many components it has."""
        return SIZES[self.type]

    @property
    def continuous(self) -> bool:
        """Whether derivatives with respect to it mean something."""
        return self.type not in ("int", "bool")


@dataclass(frozen=True)
class Brdf:
    """What makes a function a BRDF, or a factor of one: `lightmeter stress` then holds the laws of reflection of it.

    Cosines of the half vector need no word: n_dot_h, sin2_h, v_dot_h and l_dot_h are known by their names.

    Attributes:
        view, light: the arguments that change places: directions, or numbers that are the same function of either,
            as the cosines n_dot_v and n_dot_l are. view is None where the function takes none.
        normal: the argument that holds the normal; None where it takes none.
        cosine: whether n·l is in the result.
        grain: the argument that holds a direction across the normal, along which the lobe is stretched.
        below: the argument that holds f·(n·l) of what lies below; Lambert's is put there.
        whole: False for a factor, as masking is: it has no albedo.
    """

    view: str | None = "v"
    light: str = "l"
    normal: str | None = "n"
    cosine: bool = True
    grain: str | None = None
    below: str | None = None
    whole: bool = True


@dataclass(frozen=True)
class Twin:
    """A GLSL function and the NumPy function that says what it should give.

    Attributes:
        file: the GLSL file, in the effect's folder or among the shared shaders.
        function: the GLSL function's name.
        result: its GLSL type.
        arguments: in order.
        python: takes the inputs, float64 and components first: (n,) for a scalar, (3, n) for a vec3. Returns the
            result, or a tuple of the result and the out arguments.
        roundings: how many float32 roundings lie on the longest path from an argument to the result; `why` says
            which.
        why: how the roundings were counted.
        arrange: brings independently drawn inputs into a relation that matters, e.g. a light near the mirror
            direction.
        signs: for branches on a computed value: that value and the sum of the magnitudes it was added up from. Where
            float32 cannot tell its sign, either branch is right.
        cancels: the size of constants that intermediate results cancel with (1 − x near x = 1), added to Σ |x·∂f/∂x|.
        guards: numbers in the GLSL whose exact value does not matter.
        defines: what the file is compiled with.
        uniforms: knobs that the function reads, by name.
        brdf: what makes it a BRDF; None where it is none.
    """

    file: str
    function: str
    result: str
    arguments: tuple[Argument, ...]
    python: Callable
    roundings: float
    why: str
    arrange: Callable[[np.random.Generator, list[np.ndarray]], list[np.ndarray]] | None = None
    signs: Callable[..., Sequence[tuple[np.ndarray, np.ndarray]]] | None = None
    cancels: float = 0.0
    guards: tuple[str, ...] = ()
    defines: Mapping[str, object] = field(default_factory=dict)
    uniforms: Mapping[str, object] = field(default_factory=dict)
    brdf: Brdf | None = None


def uniform(low: float, high: float, components: int = 1) -> Draw:
    """Evenly over [low, high], every component by itself."""

    def draw(rng: np.random.Generator, n: int) -> np.ndarray:
        return rng.uniform(low, high, (components, n) if components > 1 else n)

    return draw


def logarithmic(low: float, high: float, components: int = 1) -> Draw:
    """Evenly over the logarithms of [low, high], low > 0: as many small as large numbers."""

    def draw(rng: np.random.Generator, n: int) -> np.ndarray:
        return np.exp(rng.uniform(np.log(low), np.log(high), (components, n) if components > 1 else n))

    return draw


def direction(rng: np.random.Generator, n: int) -> np.ndarray:
    """(3, n) unit vectors, evenly over the sphere."""
    v = rng.normal(size=(3, n))
    return v / np.linalg.norm(v, axis=0)


def whole(low: int, high: int) -> Draw:
    """Whole numbers from low to high, both included."""
    return lambda rng, n: rng.integers(low, high + 1, n).astype(np.float64)
