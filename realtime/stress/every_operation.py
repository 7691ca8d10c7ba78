"""Writes GLSL again with `held(…)` around every operation on numbers that are no whole ones.

`held`, and the `held_` functions that stand in place of built-in ones, are overloaded, so that no types have to be
known but one: whole numbers are left alone, since they size arrays and count loops.
"""

import re
import warnings
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

import numpy as np

ONCE = re.compile(
    r"radians|degrees|a?(sin|cos|tan)h?|exp2?|log2?|(inverse)?sqrt|fract|fma|determinant|inverse|outerProduct|"
    r"matrixCompMult|dFd[xy]|fwidth|texture(?!Size)\w*|texelFetch\w*|u?intBitsToFloat"
)
"""Built-in functions whose result is rounded once."""
EXACT = re.compile(
    r"abs|sign|floor|ceil|trunc|round(Even)?|min|max|clamp|step|isnan|isinf|transpose|any|all|not|"
    r"(less|greater)Than(Equal)?|equal|notEqual|bool|bvec[234]"
)
"""Those whose result a half float holds, given half floats. All others are functions of `held/`, where those that are a
formula are written out, or do not compile."""
WHOLE = re.compile(
    r"u?int|[iu]vec[234]|textureSize|floatBitsToU?[iI]nt|bitfield(Reverse|Extract|Insert)|bitCount|find[LM]SB"
)
"""Types of whole numbers, and what gives such."""
CONVERSIONS = re.compile(r"float|(vec|mat)[234]")
"""Constructors: of whole numbers they round."""
ALL_WHOLE_UP_TO = 2048
"""A half float holds every whole number up to here."""

PRIMITIVE = re.compile(r"\b(float|int|uint|bool)(?=\s*[(\[])")
MARKED = {"Float": "float", "Int": "int", "Uint": "uint", "Bool": "bool"}
"""What constructors are called while they are parsed: the grammar has C's casts, and takes (float(x) + y) for one."""

Node = Any  # tree_sitter.Node, which is imported only where something is parsed


class RewritingError(ValueError):
    """A shader that was not understood."""


def hold_operations(text: str, function: str) -> str:
    """A shader's text, its operations held; of its functions only those that one of them needs.

    Raises:
        RewritingError: it does not parse.
    """
    root = _parser().parse(PRIMITIVE.sub(lambda match: match[0].capitalize(), text).encode()).root_node
    return _Writer(root, function).text


class _Writer:
    """Writes a tree's text again; what is written differently has a method named after its kind of node.

    Attributes:
        text: what is written.
    """

    def __init__(self, root: Node, function: str) -> None:
        self._root = root
        if root.has_error:
            self._misread(next(node for node in _within(root) if node.type == "ERROR" or node.is_missing))
        outside = list(_outside(root))
        self._functions = [node for node in outside if node.type == "function_definition"]
        self._macros = {_name(node): _value(node) for node in outside if node.type == "preproc_def"}
        self._defined = {_name(node) for node in outside if node.type in ("function_definition", "struct_specifier")}
        self._needed = self._reached(function, outside)
        self._whole, _ = _declared(outside)
        self.text = self._written(root)

    def _reached(self, function: str, outside: list[Node]) -> set[str]:
        """Names of the functions that a function, macros and variables outside of functions call."""
        reached = {function}.union(*(_words(node) for node in outside if node.type in ("declaration", "preproc_def")))
        called = {_name(node): set[str]() for node in self._functions}
        for node in self._functions:
            called[_name(node)] |= _words(node)
        while new := set().union(*(called[name] for name in reached & called.keys())) - reached:
            reached |= new
        return reached

    def _misread(self, node: Node) -> str:
        row = node.start_point[0]
        line = _unmarked(_text(self._root).split("\n")[row].strip())
        raise RewritingError(f"line {row + 1} of a shader was not understood: {line!r}")

    _cast_expression = _pointer_expression = _misread

    def _written(self, node: Node) -> str:
        write = getattr(self, f"_{node.type}", None)
        return write(node) if write else self._as_it_is(node)

    def _as_it_is(self, node: Node, condition: Node | None = None) -> str:
        """The node's text, its children written again, all but a condition."""
        raw, parts, end = node.text, [], 0
        if not node.children:
            return _unmarked(raw.decode())
        for child in node.children:
            start, stop = child.start_byte - node.start_byte, child.end_byte - node.start_byte
            parts.append(raw[end:start].decode())
            parts.append(_text(child) if child == condition else self._written(child))
            end = stop
        return "".join([*parts, raw[end:].decode()])

    def _verbatim(self, node: Node) -> str:
        return _unmarked(_text(node))

    _comment = _array_declarator = _layout_specification = _preproc_call = _verbatim

    def _preproc_if(self, node: Node) -> str:
        return self._as_it_is(node, node.child_by_field_name("condition"))

    _preproc_elif = _preproc_if

    def _preproc_def(self, node: Node) -> str:
        """A macro; where its value is an expression, that is written again."""
        value = _value(node)
        tree = _parser().parse(f"float x = {value};".encode()).root_node
        if value and not tree.has_error:
            (declared,) = tree.children[0].children_by_field_name("declarator")
            value = self._written(declared.child_by_field_name("value"))
        return f"#define {_name(node)} {_unmarked(value)}\n"

    def _function_definition(self, node: Node) -> str:
        if _name(node) not in self._needed:
            return ""
        outside = self._whole
        whole, other = _declared(_within(node))
        self._whole = (outside - other) | whole
        written = self._as_it_is(node)
        self._whole = outside
        return written

    def _declaration(self, node: Node) -> str:
        """Of a constant whose value calls a function a variable is made: that is no constant expression."""
        if not _text(node).startswith("const"):
            return self._as_it_is(node)
        if WHOLE.fullmatch(_text(node.child_by_field_name("type"))):
            return self._verbatim(node)
        written = self._as_it_is(node)
        return written.removeprefix("const").lstrip() if "held" in written else written

    def _number_literal(self, node: Node) -> str:
        text = _text(node)
        return text if _is_whole_literal(text) or _fits(text) else f"held({text})"

    def _binary_expression(self, node: Node) -> str:
        left, operator, right = (node.child_by_field_name(part) for part in ("left", "operator", "right"))
        if _text(operator) not in ("+", "-", "*", "/") or self._is_whole(node):
            return self._as_it_is(node)
        if _text(operator) == "*":
            return f"held_product({self._written(left)}, {self._written(right)})"
        return f"held({self._as_it_is(node)})"

    def _assignment_expression(self, node: Node) -> str:
        left, operator, right = (node.child_by_field_name(part) for part in ("left", "operator", "right"))
        sign = _text(operator)[0]
        if sign not in "+-*/" or self._is_whole(left):
            return self._as_it_is(node)
        place, value = self._written(left), self._written(right)
        return f"{place} = " + (f"held_product({place}, {value})" if sign == "*" else f"held({place} {sign} ({value}))")

    def _call_expression(self, node: Node) -> str:
        name = _called(node)
        name = self._macros.get(name, name)
        written = self._as_it_is(node)
        if name in self._defined or EXACT.fullmatch(name) or WHOLE.fullmatch(name):
            return written
        if CONVERSIONS.fullmatch(name):
            given = node.child_by_field_name("arguments").named_children
            return f"held({written})" if any(map(self._is_rounded, given)) else written
        return f"held({written})" if ONCE.fullmatch(name) else f"held_{written}"

    def _is_rounded(self, node: Node) -> bool:
        """Whether an argument is of whole numbers that a half float may not hold."""
        text = _text(node)
        return self._is_whole(node) and not (text.isdigit() and int(text) <= ALL_WHOLE_UP_TO)

    def _is_whole(self, node: Node) -> bool:
        """Whether an expression is of whole numbers."""

        def parts(*names: str) -> bool:
            return all(self._is_whole(node.child_by_field_name(name)) for name in names)

        match node.type:
            case "number_literal":
                return _is_whole_literal(_text(node))
            case "identifier":
                return _text(node) in self._whole or _is_whole_literal(self._macros.get(_text(node), ""))
            case "call_expression":
                name, given = _called(node), node.child_by_field_name("arguments").named_children
                if EXACT.fullmatch(name):
                    return all(self._is_whole(argument) for argument in given)
                return name in self._whole or WHOLE.fullmatch(name) is not None
            case "field_expression" | "subscript_expression" | "unary_expression" | "update_expression":
                return parts("argument")
            case "binary_expression":
                return parts("left", "right")
            case "conditional_expression":
                return parts("consequence", "alternative")
            case "parenthesized_expression":
                return all(self._is_whole(child) for child in node.named_children)
        return False


@cache
def _parser():
    import tree_sitter_glsl
    from tree_sitter import Language, Parser

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # the grammar hands over an address, no capsule
        return Parser(Language(tree_sitter_glsl.language()))


def _within(node: Node) -> Iterator[Node]:
    yield node
    for child in node.children:
        yield from _within(child)


def _outside(node: Node) -> Iterator[Node]:
    """What lies within, but not within functions."""
    yield node
    if node.type != "function_definition":
        for child in node.children:
            yield from _outside(child)


def _text(node: Node) -> str:
    return node.text.decode()


def _unmarked(text: str) -> str:
    return re.sub(r"\b(Float|Int|Uint|Bool)\b", lambda match: MARKED[match[0]], text)


def _name(node: Node) -> str:
    """What a declaration, a declarator, a structure or a macro names."""
    while node.type != "identifier" and node.type != "type_identifier":
        node = node.child_by_field_name("declarator") or node.child_by_field_name("name")
    return _text(node)


def _value(macro: Node) -> str:
    value = macro.child_by_field_name("value")
    return _text(value).partition("//")[0].strip() if value else ""


def _words(node: Node) -> set[str]:
    return set(re.findall(r"\w+", _text(node)))


def _called(call: Node) -> str:
    """The name of the function, or of the type that is constructed, an array's too."""
    function = call.child_by_field_name("function")
    return _unmarked(_text(function).partition("[")[0].strip())


def _declared(nodes: Iterable[Node]) -> tuple[set[str], set[str]]:
    """Names that are declared as whole numbers, and other names."""
    whole: set[str] = set()
    other: set[str] = set()
    for node in nodes:
        if node.type in ("declaration", "parameter_declaration", "function_definition"):
            names = whole if WHOLE.fullmatch(_text(node.child_by_field_name("type"))) else other
            names |= {_name(declared) for declared in node.children_by_field_name("declarator")}
    return whole - other, other


def _is_whole_literal(text: str) -> bool:
    return re.fullmatch(r"\d+[uU]?|0[xX][0-9a-fA-F]+[uU]?", text) is not None


def _fits(literal: str) -> bool:
    """Whether a half float holds a literal, as a normal number."""
    value = float(literal.rstrip("fF"))
    with np.errstate(over="ignore"):
        return float(np.float16(value)) == value and (value == 0 or value >= 2.0**-14)
