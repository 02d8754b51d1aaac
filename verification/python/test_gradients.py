"""Gradients against central differences on seven scenes, and what is refused."""

import tomllib

import numpy as np
import pytest

import launch
from test_python import mortise, solves

pytestmark = solves


def scene(name, parameters, **changed):
    """The tables of geo/NAME.toml."""
    tables = tomllib.loads((launch.ROOT / f"geo/{name}.toml").read_text())
    tables["mesh"] = {"file": launch.ROOT / "geo" / tables["mesh"]["file"], "parameters": parameters}
    return tables | changed


def hertz():
    """Load, moduli, Poisson's ratio of a contact that grows."""
    tables = scene("hertz", {"n_upper": 8, "n_lower": 10}, probe=[{"at": [0, -0.3], "body": "block"}])
    tables["materials"]["soft"] = {"young": 70e9, "poisson": 0.33}
    tables["bodies"]["block"] = "soft"
    of = ["contact.0.force.y", ("contact.0.pressure.mean", 0, 0.005), ("contact.0.pressure.norm", 8), "energy", "probe.0.u_y"]
    return tables, of, {"boundary.2.pressure": 4.4e6, "materials.soft.young": 70e9, "materials.steel.poisson": 0.3}


def sphere():
    """Rings; a profile given by constants, of which one is a power; a load that is a function of place."""
    tables = scene("hertz_sphere", {"n_upper": 8, "n_lower": 10}, constants={"c": 0.5, "n": 2.0, "q": 4e4})
    tables["contact"][0]["initial_gap"] = "c * x^n"
    tables["boundary"][1]["pressure"] = "q * (1 + x)"
    of = ["contact.0.pressure.mean", ("contact.0.pressure.norm", 2), "energy", "contact.0.force.y"]
    return tables, of, {"constants.c": 0.5, "constants.n": 2.0, "constants.q": 4e4}


def lift_off():
    """Contact that ends where a plate bends off."""
    tables = scene("lift_off", {"n_plate": 24, "n_block": 30}, probe=[{"at": [0.7, 0.35], "body": "plate"}])
    tables["boundary"][3]["traction"] = ["h", "t"]
    return (
        tables | {"constants": {"t": 2e6, "h": 0.0}},
        ["probe.0.u_x", "probe.0.u_y", ("contact.0.pressure.norm", 4), "energy"],
        {"boundary.2.pressure": 1e6, "constants.t": 2e6, "constants.h": 0.0},
    )


def gap_close():
    """Prescribed displacements and a clearance."""
    tables = scene("gap_close", {}, probe=[{"at": [0.1, 0.1]}])
    tables["contact"][0]["clearance"] = 1e-5
    of = ["contact.0.force.y", "contact.0.pressure.mean", "energy", "probe.0.u_y"]
    return tables, of, {"boundary.2.displacement.y": -3e-4, "contact.0.clearance": 1e-5, "materials.aluminium.young": 70e9}


def stamp():
    """A rigid head under force and moment, which multi-point constraints hold; FETI has no factor to ask."""
    tables = scene("punch", {"n_punch": 12, "n_block": 30}, method={"solver": "feti"})
    tables["boundary"][1:] = [{"on": "head", "rigid": {"x": 1e-5, "force": [0, -1e6], "moment": 1e4}}]
    of = ["contact.0.force.x", "contact.0.force.y", ("contact.0.pressure.mean", 0.1, 0.3), "energy"]
    keys = {"x": 1e-5, "force.1": -1e6, "moment": 1e4}
    return tables, of, {f"boundary.1.rigid.{key}": value for key, value in keys.items()} | {"materials.steel.poisson": 0.3}


def gasket():
    """The same on a layer that gives way."""
    tables, of, by = stamp()
    tables["contact"][0]["stiffness"] = 1e12
    return tables, of, by


def shrink_fit():
    """Initial strains; a ring shrunk onto another."""
    by = {"materials.soft.thermal_expansion": 12e-6, "initial_strain.0.temperature_change": -100.0, "materials.soft.poisson": 0.3}
    return scene("shrink_fit", {}), ["contact.0.pressure.mean", ("contact.0.pressure.norm", 3), "energy"], by


@pytest.mark.parametrize("case", [hertz, sphere, lift_off, gap_close, stamp, gasket, shrink_fit])
def test_differences(case):
    tables, of, by = case()
    found = mortise.gradient(tables, of, by)
    assert found.derivative.shape == (len(of), len(by))
    for k, (key, value) in enumerate(by.items()):
        low, high = found.between[k]
        assert low < value < high
        step = min(0.5 * (value - low), 0.5 * (high - value), 5e-4 * abs(value) or 1e4)
        at = lambda to: mortise.gradient(tables, of, by | {key: to}).value
        difference = (8 * (at(value + step / 2) - at(value - step / 2)) - (at(value + step) - at(value - step))) / (6 * step)
        size = np.maximum(np.abs(difference), np.abs(found.value / (value or 1e6)))
        assert (np.abs(found.derivative[:, k] - difference) <= 1e-6 * size).all(), (key, found.derivative[:, k], difference)


REFUSED = [
    ("contact.0.pressure.max", "boundary.2.pressure", "expected energy, probe.I.u_x"),
    ("contact.1.force.x", "boundary.2.pressure", "of pairs the scene has 1, counted from 0"),
    ("probe.3.u_x", "boundary.2.pressure", "of probes the scene has 1, counted from 0"),
    (("energy", 2), "boundary.2.pressure", "expected no number"),
    ("contact.0.pressure.norm", "boundary.2.pressure", "expected a power, from 1 to 1000"),
    (("contact.0.pressure.norm", 0.5), "boundary.2.pressure", "expected a power, from 1 to 1000"),
    (("contact.0.pressure.mean", 1), "boundary.2.pressure", "expected no number, or a window, from and to along the curve"),
    ("energy", "mesh.parameters.n_plate", "mesh.parameters.n_plate: has no gradient here; expected a load"),
    ("energy", "boundary.9.pressure", "boundary.9"),
]


@pytest.mark.parametrize(("figure", "key", "message"), REFUSED)
def test_what_has_no_gradient_is_refused(figure, key, message):
    value = 24.0 if key.startswith("mesh") else 1e6
    with pytest.raises(mortise.InputError, match=message):
        mortise.gradient(lift_off()[0], [figure], {key: value})


def test_without_pressure_the_norm_has_none():
    with pytest.raises(mortise.InputError, match="nothing is loaded, where the norm has no derivative"):
        mortise.gradient(gap_close()[0], [("contact.0.pressure.norm", 2)], {"boundary.2.displacement.y": -1e-6})


def test_cases_are_refused_as_by_solve():
    with pytest.raises(mortise.InputError, match="the scene has cases; expected changes="):
        mortise.gradient(launch.scene_file("punch"), ["energy"], {"boundary.2.pressure": 1e6}, {"case": [{"scale": [1, 2]}]})
