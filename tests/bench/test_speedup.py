# SPDX-License-Identifier: AGPL-3.0-or-later
"""The model of more ranks: what messages cost, how a run is scaled to more cells, and rows of the other stages."""
import copy
import io
import unittest
from contextlib import redirect_stdout

import network
import scaled_run
import speedup
from cutwater import fresh
from network import Traffic


def account(part, tasks, results, asked_for=True):
    return {"every_rank": [{"part": "start", "seconds": part, "most": part}],
            "tasks": [{"step": "regions", "task_cost": tasks if asked_for else [], "task_after": [],
                       "task_seconds": tasks, "most": 0, "bytes": results}]}


def results(cells, part, tasks, sent):
    """Of a record of one rank, with one domain."""
    domain = {"regions": len(tasks), "colours": 2, "adjacent_regions": [],
              "region_list": [{"region": k, "copy_of": k, "number": k} for k in range(1, len(tasks) + 1)]}
    return {"ranks": 1, "cells": cells, "passes": 1, "domains": [domain], "together": account(part, tasks, sent),
            "side_by_side": [{"step": "layers", "own": 0.1, "least_ranks": 1,
                              "side": [{**account(part, [1.0], sent, False), "cost": 1.0}]}]}


class Messages(unittest.TestCase):
    def test_one_rank_sends_none(self):
        self.assertEqual(network.of_schedule(100, True, 1 << 30, 1), Traffic(0, 0))

    def test_of_a_schedule(self):
        # 10 tasks and 4 ranks are answered, the ends go through 2 levels, the results in 2 rounds to 3 others.
        self.assertEqual(network.of_schedule(10, True, 1 << 25, 4),
                         Traffic(10 + 4 + 2 + 2 * 3, 24 * 10 * 2 + 0.75 * (1 << 25)))
        # A barrier in place of the answers.
        self.assertEqual(network.of_schedule(10, False, 0, 8), Traffic(3 + 3, 24 * 10 * 3))

    def test_seconds(self):
        self.assertAlmostEqual(network.seconds(Traffic(1000, 1e9)), 2e-3 + 0.1)

    def test_only_several_hosts_hand_over(self):
        self.assertEqual(network.between_hosts(1e9, network.HOST_RANKS), Traffic(0, 0))
        two, five = (network.between_hosts(1e9, hosts * network.HOST_RANKS).bytes for hosts in (2, 5))
        self.assertGreater(two, 1e9)
        self.assertAlmostEqual(five / two, 3)

    def test_what_open_mpi_counted(self):
        folder = fresh("speedup-counted")
        (folder / "sent.0.prof").write_text("# POINT TO POINT\nE\t0\t1\t100 bytes\t5 msgs sent\t1,2\n"
                                            "I\t0\t1\t50 bytes\t2 msgs sent\nC\t0\t1\t999 bytes\t99 msgs sent\n")
        (folder / "sent.1.prof").write_text("I\t1\t0\t400 bytes\t3 msgs sent\n")
        self.assertEqual(network.counted(folder), Traffic(7, 400))
        self.assertEqual(network.counted(folder / "none"), Traffic(0, 0))


class Modelled(unittest.TestCase):
    def test_messages_are_in_the_seconds(self):
        made = results(1e6, 0.5, [2.0, 2.0], 0)
        few = speedup.Model([made])
        self.assertAlmostEqual(few.total(1), 0.5 + 4 + 0.5 + 1)
        loud = copy.deepcopy(made)
        loud["together"]["tasks"][0]["bytes"] = 4e10
        much = speedup.Model([loud])
        self.assertEqual(much.total(1), few.total(1))
        rounds = -(-4e10 // network.AT_ONCE)
        self.assertAlmostEqual(much.total(2) - few.total(2), 2.0 + rounds * 2e-6)
        self.assertAlmostEqual(much.traffic(2).bytes - few.traffic(2).bytes, 2e10)


class Scaled(unittest.TestCase):
    def test_growth_is_a_power_from_0_to_1(self):
        for small, large, wanted in ((1, 8, 27), (1, 4, 9), (2, 2, 1), (2, 1, 1), (1, 64, 27), (0, 5, 1)):
            self.assertAlmostEqual(scaled_run.growth(small, large, 8, 27), wanted)

    def test_steps_grow_as_they_did(self):
        small, large = results(1e6, 0.5, [1.0, 3.0], 100), results(8e6, 0.5, [15.0, 17.0], 400)
        made = scaled_run.with_cells(small, large, 216e6)
        self.assertEqual((made["cells"], large["cells"]), (216e6, 8e6))
        self.assertAlmostEqual(made["together"]["every_rank"][0]["seconds"], 0.5)
        # Seconds of tasks: 4 + 1 of the domain, then 32 + 1; bytes: 4 times as many with 8 times the cells.
        grown = scaled_run.growth(5, 33, 8, 27)
        self.assertAlmostEqual(made["together"]["tasks"][0]["task_seconds"][1], 17 * grown)
        self.assertAlmostEqual(made["together"]["tasks"][0]["bytes"], 400 * 9)
        self.assertEqual(large["together"]["tasks"][0]["task_seconds"], [15.0, 17.0])

    def test_asked_figures_stand_beside_the_large_run_alone(self):
        for cells, shown in ((1e9, True), (9e8, False)):
            said = io.StringIO()
            with redirect_stdout(said):
                speedup.print_table(speedup.Model([results(cells, 0.5, [2.0] * 24, 0)]), [12, 24, 256], {}, None)
            for asked in ("90.00", "85.00", "70.00"):
                self.assertEqual(f"  {asked}  " in said.getvalue(), shown, asked)


class Stages(unittest.TestCase):
    def test_the_second_rank_tells_what_is_shared(self):
        one, two = {"mesh": 8.0, "tree": 1.0, "odd": 1.0}, {"mesh": 4.5, "tree": 1.0, "odd": 1.2}
        self.assertAlmostEqual(speedup.stage_seconds(one, two, 1), 10)
        self.assertAlmostEqual(speedup.stage_seconds(one, two, 2), 4.5 + 1 + 1)
        self.assertAlmostEqual(speedup.stage_seconds(one, two, 7), 1 + 7 / 7 + 1 + 1)

    def test_they_are_scaled_step_by_step(self):
        small, large, two = {"export": {"a": 1.0, "b": 2.0}}, {"export": {"a": 8.0, "b": 2.0}}, {"export": {"a": 4.0,
                                                                                                           "b": 2.0}}
        scaled = speedup.scaled_stages(small, large, two, 8, 10)["export"]
        self.assertAlmostEqual(scaled["a"], 40)
        self.assertAlmostEqual(scaled["b"], 2)


if __name__ == "__main__":
    unittest.main()
