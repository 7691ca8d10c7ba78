"""Damaging sound files: pieces cut out, doubled, moved and overwritten, numbers and words made hostile ones."""

import re
from random import Random

_WORDS = (
    *(b"-1", b"0", b"1e999", b"-1e999", b"1e308", b"nan", b"inf", b"99999999999", b"4294967295", b"1" * 400, b"1e-320"),
    *(b"[", b"]", b"{", b"}", b'"', b"'", b"\n", b"\r", b" ", b"=", b"#", b",", b".", b"/", b"..", b"/dev/zero"),
    *(b"\xff", b"\0", b"\xef\xbb\xbf", b"null", b"true", b"[]", b"{}", b'""', b"[[[[[[[[", b"\\u0000", b"\xed\xa0\x80"),
)
_NUMBERS = (0, 1, 2, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000)
_NUMBER = re.compile(rb"-?\d+(\.\d+)?([eE][+-]?\d+)?")
_WORD = re.compile(rb"[A-Za-z_][A-Za-z_0-9]*")
LARGEST = 1 << 16
"""Bytes of a mutated file: small files take little time, and a loader's mistakes are no larger in large ones."""


def mutated(sound: bytes, random: Random) -> bytes:
    """One to six mutations of a file, now and then of none of its bytes but a cut."""
    data = sound
    for _ in range(min(6, 1 + int(random.expovariate(0.7)))):
        data = random.choice(_MUTATIONS)(data, random)
    return data[:LARGEST]


def _place(data: bytes, random: Random) -> int:
    return random.randint(0, len(data))


def _cut(data: bytes, random: Random) -> bytes:
    return data[: _place(data, random)] if random.random() < 0.2 else _removed(data, random)


def _removed(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    return data[:at] + data[at + random.randint(1, 16) :]


def _doubled(data: bytes, random: Random) -> bytes:
    at, length = _place(data, random), random.randint(1, 64)
    return data[:at] + data[at : at + length] * random.randint(2, 4) + data[at + length :]


def _moved(data: bytes, random: Random) -> bytes:
    source, target, length = _place(data, random), _place(data, random), random.randint(1, 32)
    return data[:target] + data[source : source + length] + data[target + length :]


def _bits(data: bytes, random: Random) -> bytes:
    changed = bytearray(data)
    for _ in range(random.randint(1, 4) if changed else 0):
        changed[random.randrange(len(changed))] ^= 1 << random.randrange(8)
    return bytes(changed)


def _word(data: bytes, random: Random) -> bytes:
    at = _place(data, random)
    return data[:at] + random.choice(_WORDS) + data[at + random.choice((0, 0, 1, 4)) :]


def _integer(data: bytes, random: Random) -> bytes:
    at, size = _place(data, random), random.choice((1, 2, 4))
    number = random.choice(_NUMBERS) & ((1 << 8 * size) - 1)
    return data[:at] + number.to_bytes(size, random.choice(("little", "big"))) + data[at + size :]


def _exchanged(pattern: re.Pattern[bytes], choose):
    """Exchanges one match of the pattern, so that the file's structure stays."""

    def change(data: bytes, random: Random) -> bytes:
        found = [match.span() for match in pattern.finditer(data)]
        if not found:
            return _word(data, random)
        start, end = random.choice(found)
        return data[:start] + choose(data, found, random) + data[end:]

    return change


def _another(data: bytes, found: list[tuple[int, int]], random: Random) -> bytes:
    start, end = random.choice(found)
    return data[start:end]


def _hostile(data: bytes, found: list[tuple[int, int]], random: Random) -> bytes:
    return random.choice(_WORDS)


_MUTATIONS = (
    *(_cut, _doubled, _moved, _bits, _word, _integer),
    *(_exchanged(_NUMBER, _hostile), _exchanged(_NUMBER, _another)),
    *(_exchanged(_WORD, _another), _exchanged(_WORD, _hostile)),
)
