"""Equations of motion as changes over a control step."""

import numpy as np
import pytest

import rehearse


def test_rk4_gives_a_row_the_same_bytes_in_any_array():
    """NumPy's sine of a strided column depends on its address, so columns must be contiguous."""
    chain = rehearse.rk4(lambda x, u: np.stack([np.sin(x[:, (i + 1) % 6]) for i in range(6)], axis=1), 0.1)
    states = np.asfortranarray(np.random.default_rng(1).normal(scale=3, size=(300, 6)))
    actions = np.zeros((300, 1))
    whole = chain(states, actions)
    for first in range(0, 300, 7):
        for rows in (1, 2, 3, 5, 64):
            part = chain(np.asfortranarray(states[first:first + rows]), actions[first:first + rows])
            assert np.array_equal(part, whole[first:first + rows])
    assert np.array_equal(chain(np.ascontiguousarray(states), actions), whole)


def test_runge_and_kutta():
    swing = rehearse.rk4(lambda x, u, w: np.column_stack([x[:, 1], -w**2 * x[:, 0]]), 0.1, substeps=4)
    moved = swing(np.array([[1.0, 0.0]]), np.zeros((1, 0)), w=2.0)
    np.testing.assert_allclose(moved, [[np.cos(0.2) - 1, -2 * np.sin(0.2)]], atol=1e-7)


def test_rates_may_write_into_what_they_are_given():
    def pushed(states, actions, mass):
        actions *= 1 / mass
        states[:, 1] = 0
        return np.column_stack([actions[:, 0], states[:, 0]])

    def gentle(states, actions, mass):
        return np.column_stack([actions[:, 0] / mass, states[:, 0]])

    x, u = np.array([[0.3, 1.0]]), np.array([[1.0]])
    assert (rehearse.rk4(pushed, 0.1)(x, u, mass=2.0) == rehearse.rk4(gentle, 0.1)(x, u, mass=2.0)).all()
    assert (x == [[0.3, 1.0]]).all() and u == 1


@pytest.mark.parametrize("rates, message", [
    (lambda x, u: np.array([u[0, 0], x[0, 0]]), r"rates returned an array of shape \(2,\), must be \(3, 2\)"),
    (lambda x, u: np.column_stack([u[:, 0]]), r"rates returned an array of shape \(3, 1\), must be \(3, 2\)"),
    (lambda x, u: 1.0, r"rates returned an array of shape \(\), must be \(3, 2\)"),
    (lambda x, u: None, "rates returned None, must be an array of numbers"),
    (lambda x, u: [[0.0, None]] * 3, "rates returned None, must be an array of numbers"),
    (lambda x, u: x + 1j, "rates has complex numbers"),
])
def test_what_rates_return_is_checked(rates, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        rehearse.rk4(rates, 0.1)(np.ones((3, 2)), np.ones((3, 1)))


def test_rates_of_one_state_are_a_column():
    x, u = np.ones((3, 1)), np.ones((3, 1))
    with pytest.raises(ValueError, match=r"^rates returned an array of shape \(3,\), must be \(3, 1\)"):
        rehearse.rk4(lambda x, u: u[:, 0], 0.1)(x, u)
    np.testing.assert_allclose(rehearse.rk4(lambda x, u: [[1], [2], [3]], 0.1)(x, u), [[0.1], [0.2], [0.3]])


def test_masked_rates_are_not_known():
    def rates(x, u):
        return np.ma.masked_array(x, x > 5)

    moved = rehearse.rk4(rates, 0.1)(np.array([[1.0, 6.0], [2.0, 3.0]]), np.zeros((2, 1)))
    np.testing.assert_array_equal(np.isnan(moved), [[False, True], [False, False]])
