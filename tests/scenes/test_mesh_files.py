"""OBJ and PLY."""

import struct

import numpy as np
import pytest

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.obj import load_obj
from lightmeter.scenes.ply import load_ply

POINTS = np.float32([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def obj(tmp_path, text):
    path = tmp_path / "mesh.obj"
    path.write_text(text)
    return load_obj(path)


def ply(tmp_path, data):
    path = tmp_path / "mesh.ply"
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return load_ply(path)


def area(mesh) -> np.ndarray:
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    return np.cross(b - a, c - a).sum(axis=0) / 2


QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def test_obj_with_everything(tmp_path):
    mesh, notes = obj(
        tmp_path,
        QUAD
        + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\nusemtl red\ng a\nf 1/1/1 2/2/1 \\\n3/3/1 4/4/1 # end\nl 1 2\n",
    )
    np.testing.assert_array_equal(mesh.positions, POINTS)
    np.testing.assert_array_equal(mesh.triangles, [[0, 1, 2], [0, 2, 3]])
    np.testing.assert_array_equal(mesh.normals, [[0, 0, 1]] * 4)
    np.testing.assert_array_equal(mesh.texcoords[0], [[0, 1], [1, 1], [1, 0], [0, 0]])  # v from the top
    assert any("materials" in note for note in notes) and any("kinds" in note and "l" in note for note in notes)


def test_obj_negative_indices_and_corners_without_normals(tmp_path):
    mesh, notes = obj(tmp_path, QUAD + "vn 0 0 1\nf -4 -3 -2\nf 1//1 3//1 4//1\n")
    np.testing.assert_allclose(area(mesh), [0, 0, 1])
    assert mesh.normals is None and mesh.texcoords == ()
    assert any("no normal" in note for note in notes)


def test_obj_polygons_are_fans(tmp_path):
    angles = 2 * np.pi * np.arange(7) / 7
    lines = "".join(f"v {np.cos(a)} {np.sin(a)} 0\n" for a in angles)
    mesh, _ = obj(tmp_path, lines + "f 1 2 3 4 5 6 7\n")
    assert len(mesh.triangles) == 5
    np.testing.assert_allclose(area(mesh), [0, 0, 7 / 2 * np.sin(2 * np.pi / 7)], atol=1e-6)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no faces"),
        (QUAD, "no faces"),
        (QUAD + "f 1 2 5\n", "line 5.*out of range"),
        (QUAD + "f 1 2 0\n", "line 5.*out of range"),
        (QUAD + "f 1 2 -5\n", "line 5.*out of range"),
        (QUAD + "f 1 2\n", "line 5.*three corners"),
        (QUAD + "f 1 2 x\n", "line 5"),
        (QUAD + "f 1/1 2/1 3/1\n", "line 5.*out of range"),
        (QUAD + "f 1/1/1/1 2 3\n", "line 5"),
        (QUAD + "f 1 2 " + "9" * 5000 + "\n", "line 5"),
        ("v 1 2\nf 1 1 1\n", "line 1.*too few"),
        ("v a b c\n", "line 1"),
        (QUAD + "v nan 0 0\nf 1 2 3\n", "not finite"),
        (QUAD + "v 1e400 0 0\nf 1 2 3\n", "not finite"),
        (QUAD + "v 1e39 0 0\nf 1 2 3\n", "not finite"),
    ],
)
def test_bad_obj(tmp_path, text, words):
    with pytest.raises(SceneError, match=words):
        obj(tmp_path, text)


def head(form, faces=1, vertices=4, more="", index="vertex_indices"):
    return (
        f"ply\nformat {form} 1.0\ncomment by hand\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
        f"property float z\n{more}element face {faces}\nproperty list uchar int {index}\nend_header\n"
    )


def test_ascii_ply_with_colours_and_texture_coordinates(tmp_path):
    more = "".join(f"property {kind}\n" for kind in ("float s", "float t", "uchar red", "uchar green", "uchar blue"))
    rows = "".join(f"{x} {y} 0 {x} {y} 255 128 0\n" for x, y in POINTS[:, :2])
    mesh, _ = ply(tmp_path, head("ascii", more=more) + rows + "4 0 1 2 3\n")
    np.testing.assert_array_equal(mesh.positions, POINTS)
    np.testing.assert_allclose(mesh.colors, [[1, 0.21586, 0, 1]] * 4, atol=1e-5)  # sRGB 128
    np.testing.assert_array_equal(mesh.texcoords[0], np.stack([POINTS[:, 0], 1 - POINTS[:, 1]], axis=1))
    np.testing.assert_allclose(area(mesh), [0, 0, 1])


@pytest.mark.parametrize(("form", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
@pytest.mark.parametrize("faces", [[(0, 1, 2), (0, 2, 3)], [(0, 1, 2, 3)], [(0, 1, 2), (0, 1, 2, 3), (2, 3)]])
def test_binary_ply(tmp_path, form, order, faces):
    body = POINTS.astype(f"{order}f4").tobytes()
    body += b"".join(struct.pack(f"{order}B{len(face)}i", len(face), *face) for face in faces)
    mesh, notes = ply(tmp_path, head(form, len(faces)).encode() + body)
    np.testing.assert_array_equal(mesh.positions, POINTS)
    np.testing.assert_allclose(area(mesh), [0, 0, 1.5 if len(faces) == 3 else 1])
    assert bool(notes) == (len(faces) == 3)


def test_ply_face_with_other_properties_around_the_list(tmp_path):
    header = head("binary_little_endian", 2).replace(
        "property list", "property float count\nproperty list"
    ).replace("end_header", "property uchar corners\nend_header")  # fmt: skip
    body = POINTS.tobytes() + b"".join(struct.pack("<fB3iB", 7, 3, *face, 9) for face in ((0, 1, 2), (0, 2, 3)))
    mesh, _ = ply(tmp_path, header.encode() + body)
    np.testing.assert_array_equal(mesh.triangles, [[0, 1, 2], [0, 2, 3]])


ROWS = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("", "no PLY"),
        ("ply\nformat ascii 1.0\n", "cut off"),
        (head("ascii").replace("format ascii", "format text"), "line 2"),
        (head("ascii", vertices=-1), "line 4"),
        (head("ascii", vertices="many"), "line 4"),
        (head("ascii").replace("float x", "real x"), "line 5"),
        (head("ascii").replace("float y", "float x"), "named twice"),
        (head("ascii", vertices=10**12) + ROWS, "truncated"),
        (head("ascii", faces=10**12) + ROWS + "3 0 1 2\n", "fewer faces"),
        (head("binary_little_endian", vertices=10**12), "truncated"),
        (head("binary_little_endian", vertices=0, faces=10**12), "fewer faces"),
        (head("ascii") + ROWS + "3 0 1 4\n", "expected 0 to 3, got 4"),
        (head("ascii") + ROWS + "3 0 1 -1\n", "expected 0 to 3"),
        (head("ascii") + ROWS + "3 0 1 1.5\n", "expected 0 to 3"),
        (head("ascii") + ROWS + "-3 0 1 2\n", "truncated"),
        (head("ascii") + ROWS + "1e300 0 1 2\n", "truncated"),
        (head("ascii") + ROWS + "2 0 1\n", "three corners"),
        (head("ascii") + ROWS.replace("0 1 0", "0 nan 0") + "3 0 1 2\n", "not finite"),
        (head("ascii") + ROWS.replace("0 1 0", "0 1e39 0") + "3 0 1 2\n", "not finite"),
        (head("ascii") + ROWS.replace("0 1 0", "0 x 0") + "3 0 1 2\n", "no number"),
        (head("ascii", index="corners") + ROWS + "3 0 1 2\n", "no faces"),
        (head("ascii", faces=0) + ROWS, "no faces"),
    ],
)
def test_bad_ply(tmp_path, data, words):
    with pytest.raises(SceneError, match=words):
        ply(tmp_path, data)


def test_every_truncation_of_a_binary_ply(tmp_path):
    body = POINTS.tobytes() + struct.pack("<B4i", 4, 0, 1, 2, 3)
    data = head("binary_little_endian").encode() + body
    assert ply(tmp_path, data)[0].triangles.shape == (2, 3)
    for end in range(0, len(data), 3):
        with pytest.raises(SceneError):
            ply(tmp_path, data[:end])
