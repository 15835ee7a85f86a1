"""The elastica: an inextensible strip of length 1 and flexural rigidity 1, clamped horizontally at an end."""
from functools import cache
from math import cos, pi, sin

STEPS = 1000


def shoot(end_angle, force, weight):
    """Integrates δ'' = (force + weight s) sin δ by Runge-Kutta's method from the free end, s = 0. The angle δ
    is measured from the vertical. Returns δ at the clamp, and the height and width of the strip."""
    angle, turn, height, width, ds = end_angle, 0.0, 0.0, 0.0, 1 / STEPS
    for k in range(STEPS):
        s = k * ds
        k1 = (force + weight * s) * sin(angle)
        middle_angle = angle + ds / 2 * turn
        k2 = (force + weight * (s + ds / 2)) * sin(middle_angle)
        k3 = (force + weight * (s + ds / 2)) * sin(middle_angle + ds * ds / 4 * k1)
        k4 = (force + weight * (s + ds)) * sin(angle + ds * turn + ds * ds / 2 * k2)
        middle = angle + ds / 2 * turn + ds * ds / 16 * (k1 + k2)
        following = angle + ds * turn + ds * ds / 6 * (k1 + k2 + k3)
        height += ds / 6 * (cos(angle) + 4 * cos(middle) + cos(following))
        width += ds / 6 * (sin(angle) + 4 * sin(middle) + sin(following))
        angle, turn = following, turn + ds / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if angle > pi:
            break
    return angle, height, width


@cache
def tip(force, weight):
    """How far the free end moves down and in, for a force F at the free end and a weight w per length:
    force = F L² / B, weight = w L³ / B."""
    low, high = 0.0, pi / 2
    for _ in range(60):
        end_angle = (low + high) / 2
        angle, height, width = shoot(end_angle, force, weight)
        low, high = (end_angle, high) if angle < pi / 2 else (low, end_angle)
    return height, 1 - width
