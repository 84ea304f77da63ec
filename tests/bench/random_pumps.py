# SPDX-License-Identifier: AGPL-3.0-or-later
"""Random case files over the whole range of the schema. Pump i depends on the seed and on i alone, and each of its keys
on a stream of its own, so that a new key leaves the values of the others as they are.

Ranges and choices are read from docs/case-reference.md, which the schema writes. What is narrower here says why."""
import math
import random
import re
from functools import lru_cache
from pathlib import Path

REFERENCE = Path(__file__).resolve().parents[2] / "docs/case-reference.md"
GRAVITY = 9.80665
# Duty: the range of centrifugal pumps with a radial or mixed-flow wheel, and of what is built of them.
SPECIFIC_SPEED = (6, 90)      # nq = n sqrt(Q) / H^(3/4); rpm, m3/s, m
FLOW_RATE = (0.3, 20000)      # m3/h
OUTLET_DIAMETER = (15, 5000)  # D2, mm
VISCOSITY = (1e-6, 1e-3)      # m2/s
DENSITY = (700, 1300)         # kg/m3, of liquids other than water
VISCOUS_SHARE = 0.25          # of the pumps; the others pump water
GIVEN_SPREAD = 1.1            # a given dimension is its correlation times or over this at most
OVER_DETERMINED = 0.08        # share of the pumps with options that give wrap, outlet blade angle and D2 together
EXPLICIT_LAYERS = 0.1         # share of them that give first heights
WATER = (5, 90)               # degrees Celsius
GROUPS = ("blade", "hub_shroud", "volute", "pipe")  # of walls


@lru_cache(maxsize=None)
def schema(path=REFERENCE):
    """(section, key) -> (least, most), or the tuple of choices."""
    found, section = {}, ""
    for line in path.read_text().splitlines():
        heading = re.fullmatch(r"### (\w+)", line)
        section = heading[1] if heading else section
        row = re.match(r"\| `(\w+)` \|[^|]*\| ([^|]+) \|", line)
        if not row:
            continue
        numbers = re.match(r"(?:a whole number from )?([-\d.e+]+) to ([-\d.e+]+)", row[2])
        if numbers:
            found[section, row[1]] = float(numbers[1]), float(numbers[2])
        elif re.fullmatch(r"[a-z_]+(, [a-z_]+)* or [a-z_]+", row[2]):
            found[section, row[1]] = tuple(re.split(r", | or ", row[2]))
    return found


def within(section, key, least, most):
    """The part of a range that the schema allows."""
    allowed = schema()[section, key]
    return max(least, allowed[0]), min(most, allowed[1])


def head_coefficient(nq):
    """psi = 2 g H / u2^2 at the design point; Guelich, Centrifugal Pumps, figure 3.21."""
    return 1.21 * math.exp(-0.77 * nq / 100)


def outlet_diameter(head, speed, nq):
    """D2, mm, from head in m and speed in rpm."""
    return 1000 * 60 / (math.pi * speed) * math.sqrt(2 * GRAVITY * head / head_coefficient(nq))


def water_duty(flow, head, speed, viscosity):
    """Flow and head with water of a pump that has these with a liquid of that viscosity, m2/s, or None: water;
    ANSI/HI 9.6.7, whose B ends at 40."""
    if viscosity is None:
        return flow, head
    factor = 1
    for _ in range(60):
        b = 16.5 * math.sqrt(1e6 * viscosity) * (head / factor)**0.0625 / ((flow / factor)**0.375 * speed**0.25)
        factor = math.exp(-0.165 * math.log10(min(b, 40))**3.15) if b > 1 else 1
    return flow / factor, head / factor


class Stream:
    """Random numbers of one key of one pump. Only random() is used: Python keeps its values for a seed."""

    def __init__(self, *name):
        self.random = random.Random("/".join(map(str, name))).random

    def even(self, least, most):
        return least + (most - least) * self.random()

    def log(self, least, most):
        return least * (most / least) ** self.random()

    def choice(self, choices):
        return choices[int(len(choices) * self.random())]

    def chance(self, share):
        return self.random() < share


def draw_duty(stream):
    """Flow rate in m3/h, head in m, speed in rpm: nq log-uniform, flow and head so where the range of D2 and the schema
    allow them at that nq."""
    nq = stream("nq").log(*SPECIFIC_SPEED)
    flows, heads = within("operating_point", "flow_rate_m3_per_h", *FLOW_RATE), schema()["operating_point", "head_m"]
    speeds = schema()["operating_point", "speed_rpm"]
    diameters = within("impeller", "outlet_diameter_mm", *OUTLET_DIAMETER)
    duty = stream("flow_and_head")
    while True:
        flow, head = duty.log(*flows), duty.log(*heads)
        speed = nq * head**0.75 / math.sqrt(flow / 3600)
        if speeds[0] <= speed <= speeds[1] and diameters[0] <= outlet_diameter(head, speed, nq) <= diameters[1]:
            return flow, head, speed


def draw_fluid(stream):
    fluid = stream("fluid")
    if not fluid.chance(VISCOUS_SHARE):
        return {}
    return {"kinematic_viscosity_m2_per_s": fluid.log(*within("fluid", "kinematic_viscosity_m2_per_s", *VISCOSITY)),
            "density_kg_per_m3": fluid.even(*within("fluid", "density_kg_per_m3", *DENSITY))}


class Options:
    """Keys beyond the duty, each with a chance of its own. Lengths are drawn as shares of the main dimensions that
    published correlations give for the duty."""

    def __init__(self, stream, flow, head, speed):
        self.stream, self.sections = stream, {}
        nq = speed * math.sqrt(flow / 3600) / head**0.75
        x, psi = nq / 100, head_coefficient(nq)
        self.nq, self.d2 = nq, outlet_diameter(head, speed, nq)
        # Guelich, tables 7.1 and 10.2, with a hub of 0.12 D2.
        self.hub = 0.12 * self.d2
        self.d1 = self.d2 * 1.16 * math.sqrt(0.12**2 + 1.5e-3 * psi * nq**1.33)
        self.b2 = self.d2 * (0.017 + 0.262 * x - 0.08 * x**2 + 0.0093 * x**3)
        self.b3 = self.b2 * (1 + max(0.15, 0.6 - 0.75 * x))
        self.d3 = 1.04 * self.d2

    def put(self, section, key, chance, value):
        """With this chance value(stream) is written; a length outside of the schema is not."""
        own = self.stream(f"{section}.{key}")
        if not own.chance(chance):
            return False
        drawn, allowed = value(own), schema()[section, key]
        if not isinstance(drawn, str) and not allowed[0] <= drawn <= allowed[1]:
            return False
        self.sections.setdefault(section, {})[key] = drawn
        return True

    def length(self, section, key, chance, size, least=1 / GIVEN_SPREAD, most=GIVEN_SPREAD):
        return self.put(section, key, chance, lambda own: size * own.log(least, most))

    def even(self, section, key, chance, least, most):
        return self.put(section, key, chance, lambda own: own.even(*within(section, key, least, most)))

    def select(self, section, key, chance):
        return self.put(section, key, chance, lambda own: own.choice(schema()[section, key]))

    def impeller(self):
        for key in ("rotation", "blade_form", "trailing_edge"):
            self.select("impeller", key, 0.5)
        self.select("impeller", "suction_pipe_zone", 0.4)
        self.put("impeller", "blade_count", 0.6, lambda own: own.choice(range(*count_range("blade_count", 2, 12))))
        self.length("impeller", "outlet_diameter_mm", 0.25, self.d2, 0.97, 1.06)
        self.length("impeller", "inlet_diameter_mm", 0.2, self.d1)
        self.length("impeller", "outlet_width_mm", 0.2, self.b2)
        self.even("impeller", "wrap_angle_deg", 0.15, 90, 150)
        self.even("impeller", "outlet_blade_angle_deg", 0.15, 18, 32)
        self.even("impeller", "lean_deg", 0.25, -15, 15)
        self.even("impeller", "leading_edge_ratio", 0.3, 1, 4)
        self.even("impeller", "thickest_at", 0.3, 0.3, 0.6)
        self.length("impeller", "blade_thickness_mm", 0.2, 0.02 * self.d2, 0.6, 1.25)
        if self.even("impeller", "splitter_start", 0.25, 0.3, 0.6):
            self.even("impeller", "splitter_position", 0.5, 0.42, 0.58)
        self.length("impeller", "through_shaft_diameter_mm", 0.15, self.hub, 0.6, 1)
        self.length("impeller", "root_fillet_radius_mm", 0.25, self.b2, 0.03, 0.1)

    def volute(self):
        for key in ("area_law", "section", "discharge"):
            self.select("volute", key, 0.6)
        self.select("volute", "discharge_pipe_zone", 0.4)
        self.length("volute", "base_diameter_mm", 0.25, self.d3, 1, 1.1)
        self.length("volute", "inlet_width_mm", 0.2, self.b3, 1, 1.2)
        self.even("volute", "side_wall_angle_deg", 0.2, 5, 30)
        if not self.even("volute", "tongue_angle_deg", 0.15, 15, 45):
            self.length("volute", "tongue_gap_mm", 0.15, 0.03 * self.d2, 0.5, 2)
        if not self.even("volute", "diffuser_angle_deg", 0.2, 6, 12):
            self.length("volute", "diffuser_length_mm", 0.1, self.d2, 0.5, 1.5)
        self.even("volute", "diffuser_area_ratio", 0.2, 1.4, 3)

    def walls(self):
        own = self.stream("walls")
        y_plus = own.log(*within("walls", "y_plus_blade", 0.5, 200))
        for group in GROUPS:
            self.put("walls", f"y_plus_{group}", 1 if own.chance(0.6) else 0, lambda _: y_plus)
        self.put("walls", "layer_count", 0.5, lambda own: own.choice(range(1, 21)))
        self.even("walls", "growth_ratio", 0.5, 1.05, 1.4)

    def given(self, section, key, otherwise=None):
        return self.sections.get(section, {}).get(key, otherwise)

    def laws(self):
        """Whose laws the design follows; now and then more is given than they leave open."""
        self.select("design", "correlations", 0.25)
        self.select("design", "slip", 0.25)
        if self.stream("over_determined").chance(OVER_DETERMINED):
            for key, least, most in (("wrap_angle_deg", 90, 150), ("outlet_blade_angle_deg", 18, 32),
                                     ("outlet_diameter_mm", 0.97 * self.d2, 1.06 * self.d2)):
                if not self.given("impeller", key):
                    self.even("impeller", key, 1, least, most)
        laws = ["auto"] + [law for law, key in (("wrap", "wrap_angle_deg"), ("beta", "outlet_blade_angle_deg"))
                           if self.given("impeller", key)]
        # For the head D2 must be open: 12 to 60 degrees at the outlet do not meet any head.
        if not self.given("impeller", "outlet_diameter_mm"):
            laws.append("head")
        self.put("impeller", "priority", 0.25, lambda own: own.choice(laws))

    def nose_and_edges(self):
        """The hub's nose, and both edges of the blade: a shaft is no thicker than the hub, an edge than the blade."""
        shaft = self.given("impeller", "through_shaft_diameter_mm", 0)
        self.put("impeller", "hub_diameter_mm", 0.15, lambda own: max(shaft, self.hub * own.log(0.95, 1.15)))
        hub = self.given("impeller", "hub_diameter_mm", self.hub)
        self.length("impeller", "hub_nut_length_mm", 0.15, 7 / 12 * (hub - shaft), 0.7, 1.3)
        self.length("impeller", "hub_nut_flat_diameter_mm", 0.15, 0.29 * hub, 0.6, 1.3)
        # 0.635 D1, and drawn into the eye above nq 25.
        share = 0.635 - 0.003 * min(35, max(0, self.nq - 25))
        shroud = share * self.given("impeller", "inlet_diameter_mm", self.d1)
        self.length("impeller", "leading_edge_radius_shroud_mm", 0.12, shroud, 0.97, 1.08)
        # Who gives the hub's leading edge has a hub that it lies outside of.
        if 1.15 * hub / 2 < 0.7 * shroud and self.given("impeller", "hub_diameter_mm"):
            self.length("impeller", "leading_edge_radius_hub_mm", 0.5, shroud, 0.7, 0.9)
        thickness = self.given("impeller", "blade_thickness_mm", 0)
        # The edges of all blades, at the least blade angle of 12 degrees, take no more than half of the inlet.
        room = 0.5 * math.sin(math.radians(12)) * 2 * math.pi * shroud / self.given("impeller", "blade_count", 7)
        self.length("impeller", "leading_edge_thickness_mm", 0.5, min(thickness, room / 0.9), 0.5, 0.9)
        self.length("impeller", "trailing_edge_thickness_mm", 0.5, thickness, 0.3, 0.5)

    def throat(self, flow, head):
        """Throat by Stepanoff's velocity, corners and tongue."""
        speed = 0.42 * (self.nq / 20) ** -0.2 * math.sqrt(2 * GRAVITY * head)
        self.length("volute", "throat_area_mm2", 0.12, 1e6 * flow / 3600 / speed, 0.8, 1.1)
        self.length("volute", "tongue_radius_mm", 0.15, 0.0075 * self.d2, 0.6, 1.2)
        if self.given("volute", "section") != "circle":
            width = self.given("volute", "inlet_width_mm", self.b3)
            self.put("volute", "corner_radius_mm", 0.15,
                     lambda own: max(0.004 * self.d3, width * own.log(0.08, 0.2)))

    def explicit_layers(self, head, viscosity):
        """First heights instead of y+, and the thickness of all layers: with u_tau = 0.045 u2 and at the centre of the
        first cell, as far as half of the passage takes all layers."""
        own = self.stream("explicit_layers")
        if not own.chance(EXPLICIT_LAYERS):
            return
        tip_speed = math.sqrt(2 * GRAVITY * head / head_coefficient(self.nq))
        height = min(2e3 * own.log(1, 100) * viscosity / (0.045 * tip_speed), 0.01 * self.b2)
        for group in GROUPS:
            self.put("walls", f"first_height_{group}_um", 0.8, lambda _: 1e3 * height)
        count = self.given("walls", "layer_count")
        if count:
            self.put("walls", "total_thickness_mm", 0.5, lambda own: height * count * own.even(1.1, 2))


def count_range(key, least, most):
    low, high = within("impeller", key, least, most)
    return int(low), int(high) + 1


def pump(seed, index, options=False):
    """The case of pump `index` as {section: {key: value}}."""
    kind = "options" if options else "duty"

    def stream(key):
        return Stream(seed, kind, index, key)

    flow, head, speed = draw_duty(stream)
    case = {"operating_point": {"flow_rate_m3_per_h": flow, "head_m": head, "speed_rpm": speed}}
    fluid = draw_fluid(stream)
    if fluid:
        case["fluid"] = fluid
    if options:
        viscosity = fluid.get("kinematic_viscosity_m2_per_s")
        flow, head = water_duty(flow, head, speed, viscosity)
        more = Options(stream, flow, head, speed)
        more.impeller()
        more.volute()
        more.walls()
        more.laws()
        more.nose_and_edges()
        more.throat(flow, head)
        more.explicit_layers(head, viscosity or 1e-6)
        case.update(more.sections)
        warm = stream("fluid.temperature_c")
        if not fluid and warm.chance(0.2):
            case["fluid"] = {"temperature_c": warm.even(*WATER)}
    return case


def case_text(name, case):
    """The case as YAML; numbers with five digits, as people write them, and to lie within the range after rounding."""
    lines = [f"name: {name}"]
    for section, keys in case.items():
        lines += ["", f"{section}:"]
        for key, value in keys.items():
            lines.append(f"  {key}: {value if isinstance(value, (str, int)) else format(value, '.5g')}")
    return "\n".join(lines) + "\n"
