"""Lights and surroundings, in radiometric units: VTK's shader adds colour · brdf · cosine, with no factor π."""

import math
from pathlib import Path

import numpy as np
import OpenEXR
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def light(described: dict) -> vtk.vtkLight:
    """A light of camera.json; its colour is the irradiance (W/m²) or the intensity (W/sr)."""
    made = vtk.vtkLight()
    made.SetLightTypeToSceneLight()
    if described["kind"] == "directional":
        made.PositionalOff()
        made.SetFocalPoint(0, 0, 0)
        made.SetPosition(*(-np.array(described["direction"])))
        made.SetColor(described["irradiance_w_per_m2"])
        return made
    made.PositionalOn()
    made.SetAttenuationValues(0, 0, 1)  # over the squared distance
    made.SetColor(described["intensity_w_per_sr"])
    position = np.array(described["position_m"])
    made.SetPosition(position)
    if described["kind"] == "point":
        made.SetConeAngle(180)  # above 90 VTK takes it for a point
    else:
        made.SetFocalPoint(position + described["direction"])
        made.SetConeAngle(math.degrees(_where_a_spot_halves(described["inner_rad"], described["outer_rad"])))
        made.SetExponent(0)
    return made


def nothing() -> vtk.vtkLight:
    """A light of no colour: without any light VTK shows the bare base colours."""
    made = vtk.vtkLight()
    made.SetLightTypeToSceneLight()
    made.SetColor(0, 0, 0)
    return made


def _where_a_spot_halves(inner: float, outer: float) -> float:
    """VTK's cones have a hard edge. glTF's falloff is t², t linear in the angle's cosine: it halves at t = √½."""
    return math.acos(math.cos(outer) + math.sqrt(0.5) * (math.cos(inner) - math.cos(outer)))


def surroundings(path: Path) -> vtk.vtkTexture:
    """A lat-long environment map, in floats."""
    with OpenEXR.File(str(path)) as file:
        pixels = file.channels()["RGB"].pixels
    height, width, _ = pixels.shape
    image = vtk.vtkImageData()
    image.SetDimensions(width, height, 1)
    bottom_first = np.ascontiguousarray(pixels[::-1], np.float32).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(bottom_first, deep=True))
    texture = vtk.vtkTexture()
    texture.SetInputData(image)
    texture.SetColorModeToDirectScalars()
    texture.MipmapOn()
    texture.InterpolateOn()
    return texture


def sky(texture: vtk.vtkTexture) -> vtk.vtkSkybox:
    """What is seen behind everything."""
    made = vtk.vtkSkybox()
    made.SetProjectionToSphere()
    made.SetTexture(texture)
    return made
