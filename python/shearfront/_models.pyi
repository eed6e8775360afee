# SPDX-License-Identifier: BSD-3-Clause
# Written by scripts/stubs.py from the lists of the library; not to be edited.
from typing import Any, ClassVar, Literal

from numpy.typing import ArrayLike

class Model:
    model_name: ClassVar[str]
    list_name: ClassVar[str]
    formula: ClassVar[str]
    entry_names: ClassVar[tuple[str, ...]]
    def __init__(self, *values: Any, **entries: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]: ...

class Pieces(Model):
    breaks: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, breaks: ArrayLike, values: ArrayLike) -> None: ...

def Step(height: float, below: float = ..., above: float = ...) -> Pieces: ...

class Bagnold(Model):
    angle: float
    grain: float
    static_friction: float
    friction_range: float
    inertial_number: float
    gravity: float
    surface: float
    def __init__(self, angle: float, grain: float, static_friction: float = ..., friction_range: float = ..., inertial_number: float = ..., gravity: float = ..., surface: float = ...) -> None: ...

class BagnoldVelocity(Model):
    angle: float
    grain: float
    surface: float
    static_friction: float
    friction_range: float
    inertial_number: float
    gravity: float
    ground: float
    def __init__(self, angle: float, grain: float, surface: float, static_friction: float = ..., friction_range: float = ..., inertial_number: float = ..., gravity: float = ..., ground: float = ...) -> None: ...

class BuckleyLeverett(Model):
    viscosity_ratio: float
    def __init__(self, viscosity_ratio: float) -> None: ...

class Burgers(Model):
    lowest: float
    highest: float
    def __init__(self, lowest: float = ..., highest: float = ...) -> None: ...

class Chute(Model):
    amplitude: float
    decay: float
    centre: float
    def __init__(self, amplitude: float, decay: float, centre: float = ...) -> None: ...

class Cubic(Model):
    gamma: float
    scaling: Literal["none", "quadratic-extremum"]
    def __init__(self, gamma: float, scaling: Literal["none", "quadratic-extremum"] = ...) -> None: ...

class Exponential(Model):
    amplitude: float
    decay: float
    def __init__(self, amplitude: float, decay: float) -> None: ...

class FluxTable(Model):
    phi: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, phi: ArrayLike, values: ArrayLike) -> None: ...

class Kinetic(Model):
    amplitude: float
    length: float
    load: float
    ground: float
    lid: float
    def __init__(self, amplitude: float, length: float, load: float, ground: float = ..., lid: float = ...) -> None: ...

class KinkInitial(Model):
    below: float
    above: float
    centre: float
    width: float
    def __init__(self, below: float, above: float, centre: float, width: float) -> None: ...

class LinearVelocity(Model):
    slope: float
    slip: float
    def __init__(self, slope: float, slip: float = ...) -> None: ...

class Lwr(Model):
    jam: float
    def __init__(self, jam: float = ...) -> None: ...

class LwrCubic(Model):
    gamma: float
    jam: float
    def __init__(self, gamma: float, jam: float = ...) -> None: ...

class PackingPolynomial(Model):
    pure: float
    def __init__(self, pure: float = ...) -> None: ...

class PackingTable(Model):
    share: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, share: ArrayLike, values: ArrayLike) -> None: ...

class PackingUpperBound(Model):
    pure: float
    def __init__(self, pure: float = ...) -> None: ...

class Piecewise(Model):
    breaks: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, breaks: ArrayLike, values: ArrayLike) -> None: ...

class Quadratic(Model):
    def __init__(self) -> None: ...

class RichardsonZaki(Model):
    exponent: float
    def __init__(self, exponent: float) -> None: ...

class ScalingBagnold(Model):
    angle: float
    grain: float
    small_diameter: float
    size_ratio: float
    static_friction: float
    friction_range: float
    inertial_number: float
    gravity: float
    surface: float
    share: float
    packing: float
    B: float
    C: float
    E: float
    def __init__(self, angle: float, grain: float, small_diameter: float, size_ratio: float, static_friction: float = ..., friction_range: float = ..., inertial_number: float = ..., gravity: float = ..., surface: float = ..., share: float = ..., packing: float = ..., B: float = ..., C: float = ..., E: float = ...) -> None: ...

class ScalingExponential(Model):
    amplitude: float
    decay: float
    small_diameter: float
    size_ratio: float
    share: float
    packing: float
    pressure: float
    density: float
    gravity: float
    lid: float
    B: float
    C: float
    E: float
    def __init__(self, amplitude: float, decay: float, small_diameter: float, size_ratio: float, share: float = ..., packing: float = ..., pressure: float = ..., density: float = ..., gravity: float = ..., lid: float = ..., B: float = ..., C: float = ..., E: float = ...) -> None: ...

class ScalingKinetic(Model):
    amplitude: float
    length: float
    load: float
    small_diameter: float
    size_ratio: float
    ground: float
    lid: float
    share: float
    packing: float
    B: float
    C: float
    E: float
    def __init__(self, amplitude: float, length: float, load: float, small_diameter: float, size_ratio: float, ground: float = ..., lid: float = ..., share: float = ..., packing: float = ..., B: float = ..., C: float = ..., E: float = ...) -> None: ...

class ScalingTable(Model):
    z: tuple[float, ...]
    values: tuple[float, ...]
    small_diameter: float
    size_ratio: float
    share: float
    packing: float
    pressure: float
    density: float
    gravity: float
    lid: float
    B: float
    C: float
    E: float
    def __init__(self, z: ArrayLike, values: ArrayLike, small_diameter: float, size_ratio: float, share: float = ..., packing: float = ..., pressure: float = ..., density: float = ..., gravity: float = ..., lid: float = ..., B: float = ..., C: float = ..., E: float = ...) -> None: ...

class ScalingVelocity(Model):
    z: tuple[float, ...]
    velocity: tuple[float, ...]
    small_diameter: float
    size_ratio: float
    share: float
    packing: float
    pressure: float
    density: float
    gravity: float
    lid: float
    B: float
    C: float
    E: float
    def __init__(self, z: ArrayLike, velocity: ArrayLike, small_diameter: float, size_ratio: float, share: float = ..., packing: float = ..., pressure: float = ..., density: float = ..., gravity: float = ..., lid: float = ..., B: float = ..., C: float = ..., E: float = ...) -> None: ...

class SineInitial(Model):
    amplitude: float
    wavelength: float
    mean: float
    origin: float
    def __init__(self, amplitude: float, wavelength: float, mean: float = ..., origin: float = ...) -> None: ...

class Table(Model):
    z: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, z: ArrayLike, values: ArrayLike) -> None: ...

class TableInitial(Model):
    z: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, z: ArrayLike, values: ArrayLike) -> None: ...

class TableVelocity(Model):
    z: tuple[float, ...]
    values: tuple[float, ...]
    def __init__(self, z: ArrayLike, values: ArrayLike) -> None: ...

class Triangular(Model):
    critical: float
    jam: float
    def __init__(self, critical: float, jam: float = ...) -> None: ...

class UniformVelocity(Model):
    value: float
    def __init__(self, value: float) -> None: ...

MODELS: dict[str, type[Model]]

def model_of(list_name: str, table: dict[str, Any]) -> Model | None: ...
def fields_of(model: dict[str, Any]) -> list[dict[str, Any]]: ...
def short_number(x: float) -> str: ...

__all__ = [
    "Model",
    "Pieces",
    "Step",
    "Bagnold",
    "BagnoldVelocity",
    "BuckleyLeverett",
    "Burgers",
    "Chute",
    "Cubic",
    "Exponential",
    "FluxTable",
    "Kinetic",
    "KinkInitial",
    "LinearVelocity",
    "Lwr",
    "LwrCubic",
    "PackingPolynomial",
    "PackingTable",
    "PackingUpperBound",
    "Piecewise",
    "Quadratic",
    "RichardsonZaki",
    "ScalingBagnold",
    "ScalingExponential",
    "ScalingKinetic",
    "ScalingTable",
    "ScalingVelocity",
    "SineInitial",
    "Table",
    "TableInitial",
    "TableVelocity",
    "Triangular",
    "UniformVelocity",
]
