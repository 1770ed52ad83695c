"""Parameters from arrays."""

import numpy as np
import pytest
from robots import cart, change

import rehearse
from rehearse.tables import to_csv


def log(seed, steps=60):
    rng = np.random.default_rng(seed)
    x, rows, forces = np.array([[0.0, 1.0]]), [], []
    for step in range(steps):
        force = rng.uniform(-3, 3) if step % 5 == 0 else force
        rows.append(x[0])
        forces.append(force)
        x = x + change(x, np.array([[force]]), mass=1.6, friction=0.3)
    states = np.array(rows) + 1e-3 * rng.normal(size=(steps, 2))
    return {"time": 0.1 * np.arange(steps), "velocity": states[:, 0], "position": states[:, 1], "force": forces}


def test_arrays_tell_the_mass(tmp_path):
    found = rehearse.identify(cart(plant=None), [log(1), log(2)], held_out=[log(3)], options={"beyond": "nothing"})
    mass = found.parameters[found.parameters["parameter"] == "mass"][0]
    assert mass["value"] == pytest.approx(1.6, rel=0.02)
    assert mass["low"] < 1.6 < mass["high"]
    assert "mass" in str(found)
    assert found.report(tmp_path / "page.html").read_text().startswith("<!")


def test_what_is_no_column_of_numbers_is_no_obstacle():
    rows = log(1)
    more = {"contacts": [[1]] * 59 + [[1, 2]], "label": "cart", "phase": np.array("x"), "settings": {"a": 1}}
    lines = to_csv({**rows, **more}).splitlines()
    assert lines[0] == "time,velocity,position,force,contacts" and lines[-1].endswith(',"[1, 2]"')
    found, known = (rehearse.identify(cart(plant=None), [each], options={"beyond": "nothing"}).parameters
                    for each in ({**rows, **more}, rows))
    np.testing.assert_array_equal(found[["value", "low", "high"]], known[["value", "low", "high"]])


def test_parameters_have_a_figure():
    pytest.importorskip("matplotlib")
    found = rehearse.identify(cart(plant=None), [log(1)], options={"beyond": "nothing"})
    assert list(found.tables["parameters"]["unit"]) == [""], "a text, also where there is none"
    assert found.tables["zeros"]["log"].dtype.kind == "U" and found.tables["accuracy"]["horizon"].dtype == float
    assert found.tables["accuracy"]["compared"].dtype == np.int64
    assert found.tables["accuracy"]["unit"].dtype.kind == found.tables["warnings"]["text"].dtype.kind == "U"
    assert [axis.get_ylabel() for axis in found.plot().axes] == ["mass"]


def test_a_summary_is_text_in_a_notebook():
    found = rehearse.Identification({}, "p < 0.05 & <b>mass</b>", [], "")
    assert found._repr_html_() == "<pre>p &lt; 0.05 &amp; &lt;b&gt;mass&lt;/b&gt;</pre>"


def test_logs_that_are_wrong_are_named():
    wrong = log(1)
    wrong["velocity"] = wrong["velocity"][:10]
    with pytest.raises(rehearse.InvalidInput, match="velocity has 10 numbers, column time 60"):
        rehearse.identify(cart(plant=None), [wrong])
    del wrong["velocity"]
    with pytest.raises(rehearse.InvalidInput, match="log-1.csv.*velocity"):
        rehearse.identify(cart(plant=None), [wrong])
    with pytest.raises(TypeError, match="an episode is a path"):
        rehearse.identify(cart(plant=None), [3])
