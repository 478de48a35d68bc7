"""The cable and its robots as a MuJoCo model.

The cable is a one-dimensional flex: vertices that move freely in space, edges that keep their
lengths (an equality constraint) and that cannot pass through each other. Bending stiffness is in
fixed tendons, one per inner vertex and axis, whose length is the second difference of positions;
drag is joint damping. So all forces are computed inside MuJoCo, and implicitly where they damp.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from knotopt.arrays import FloatArray, IntArray
from knotopt.errors import RequirementError
from knotopt.sim.material import Material

if TYPE_CHECKING:
    import mujoco


GRAVITY = 9.81
LEAST_EDGES = 4  # of the cable between two robots


@dataclass(frozen=True, eq=False)
class CableModel:
    """A cable and its robots, compiled.

    Attributes
    ----------
    model : mujoco.MjModel
        Three coordinates per vertex, in order; three actuators per robot, which take velocities.
    origin : float array, shape (M, 3)
        Positions of the vertices where all coordinates are zero [m].
    held : int array, shape (R,)
        Vertex that each robot holds.
    edge_lengths : float array, shape (M - 1,)
        [m]
    """

    model: mujoco.MjModel
    origin: FloatArray
    held: IntArray
    edge_lengths: FloatArray


def cable_model(lengths: FloatArray, step: float, material: Material, dt: float) -> CableModel:
    """A cable with robots at its ends and in between.

    Parameters
    ----------
    lengths : float array, shape (R - 1,)
        Of cable between consecutive robots [m].
    step : float
        Grid step [m].
    material : Material
    dt : float
        Time step [s].

    Raises
    ------
    RequirementError
        A cable too thick for its edges, or too stiff for the time step.
    """
    import mujoco

    counts = np.maximum(LEAST_EDGES, np.round(lengths / (material.edge * step))).astype(np.int64)
    edges = np.repeat(lengths / counts, counts)
    if edges.min() < 3 * material.radius:
        raise RequirementError(
            f"a cable of radius {material.radius:g} m cannot be made of edges of "
            f"{edges.min():g} m: they take three radii"
        )
    weight = material.density * GRAVITY
    bending = weight * (material.bending * step) ** 3
    fastest = np.sqrt(16 * bending / (material.density * edges.min() ** 4))
    if fastest * dt > 1:
        raise RequirementError(
            f"a cable that bends over {material.bending:g} grid steps is too stiff for a time step "
            f"of {dt:g} s"
        )
    held = np.concatenate(([0], np.cumsum(counts)))
    masses = material.density * np.convolve(edges, [0.5, 0.5])
    origin = np.zeros((len(masses), 3))
    origin[1:, 0] = np.cumsum(edges)
    model = mujoco.MjModel.from_xml_string(_xml(origin, masses, held, bending, material, dt))
    # The compiler refuses joint damping on a flex, the solver does not.
    model.dof_damping[:] = np.repeat(masses / material.drag_time, 3)
    return CableModel(model, origin, held, edges)


def _xml(
    origin: FloatArray,
    masses: FloatArray,
    held: IntArray,
    bending: float,
    material: Material,
    dt: float,
) -> str:
    robots = set(held.tolist())
    bodies, tendons, actuators = [], [], []
    for i, (mass, x) in enumerate(zip(masses.tolist(), origin[:, 0].tolist(), strict=True)):
        total = mass + (material.robot_mass if i in robots else 0.0)
        # Robots carry themselves; what they have to spare carries the cable.
        bodies.append(
            f'<body name="{i}" pos="{x!r} 0 0" gravcomp="{1 - mass / total!r}">'
            f'<inertial pos="0 0 0" mass="{total!r}" diaginertia="1e-6 1e-6 1e-6"/>'
            f'<joint name="x{i}" type="slide" axis="1 0 0"/>'
            f'<joint name="y{i}" type="slide" axis="0 1 0"/>'
            f'<joint name="z{i}" type="slide" axis="0 0 1"/></body>'
        )
        if i in robots:
            gain = total / material.response
            actuators += [
                f'<velocity joint="{axis}{i}" kv="{gain!r}" '
                f'forcerange="{-material.force!r} {material.force!r}"/>'
                for axis in "xyz"
            ]
        elif bending:
            stiffness = bending / (origin[i, 0] - origin[i - 1, 0]).item() ** 3
            tendons += [
                f'<fixed stiffness="{stiffness!r}" springlength="0">'
                f'<joint joint="{axis}{i - 1}" coef="1"/><joint joint="{axis}{i}" coef="-2"/>'
                f'<joint joint="{axis}{i + 1}" coef="1"/></fixed>'
                for axis in "xyz"
            ]
    vertices = range(len(masses))
    contact = "condim='1'"
    if material.friction:
        contact = f"condim='3' friction='{material.friction!r} 0 0'"
    return f"""
<mujoco>
  <option timestep="{dt!r}" gravity="0 0 {-GRAVITY}" solver="Newton" integrator="Euler">
    <flag autoreset="disable" island="disable"/>
  </option>
  <size memory="64M"/>
  <worldbody>{"".join(bodies)}</worldbody>
  <deformable>
    <flex name="cable" dim="1" radius="{material.radius!r}"
        body="{" ".join(str(i) for i in vertices)}"
        element="{" ".join(f"{i} {i + 1}" for i in vertices[:-1])}">
      <contact selfcollide="auto" {contact} solref="{2 * dt!r} 1" solimp=".95 .99 .001"/>
    </flex>
  </deformable>
  <equality><flex flex="cable" solref="{2 * dt!r} 1" solimp=".99 .999 .0001"/></equality>
  <tendon>{"".join(tendons)}</tendon>
  <actuator>{"".join(actuators)}</actuator>
</mujoco>"""
