# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the mesher's ranks send one another, from the record of a run on any number of them, and how long it takes.

A message takes LATENCY and its bytes over BANDWIDTH; those of the busiest rank follow one another, and nobody computes
meanwhile. Of each schedule (mesher/parallel/schedule.c) it sends

  questions   an answer for each task and each rank, where tasks are asked for (those with predicted costs; the mesher
              answers several at a time, so there are fewer); else a barrier
  ends        owner, size and seconds of each task, by a reduction over all ranks
  results     its part of them to each other rank, in rounds of AT_ONCE bytes

Ranks of a host share memory for what is large; the model lets it travel all the same. What a domain's ranks hand to
other hosts is in no record: all that a host holds once (pipeline/needs.py) is taken for it, in messages of TO_ALL
bytes, sent on from host to host in a binomial tree, HOST_RANKS ranks on each."""
import math
import re
from collections import namedtuple
from pathlib import Path

from runs import needs

LATENCY, BANDWIDTH = 2e-6, 1e10  # s, bytes a second
AT_ONCE, TO_ALL = 1 << 24, 1 << 20  # bytes: mesher/parallel/ranks.c
HOST_RANKS = 24  # those of a node of Tianhe-2
TASK_END = 24  # bytes: mesher/parallel/schedule.c

Traffic = namedtuple("Traffic", "messages bytes")  # of the busiest rank
NONE = Traffic(0, 0)


def seconds(traffic):
    return traffic.messages * LATENCY + traffic.bytes / BANDWIDTH


def total(several):
    return Traffic(*map(sum, zip(NONE, *several)))


def levels(count):
    """Of a binomial tree over so many."""
    return (count - 1).bit_length()


def of_schedule(tasks, asked_for, results, ranks):
    """Of one schedule of so many tasks, with so many bytes of results for all."""
    if ranks == 1:
        return NONE
    answers = tasks + ranks if asked_for else levels(ranks)
    rounds = math.ceil(results / AT_ONCE)
    return Traffic(answers + levels(ranks) + rounds * (ranks - 1),
                   TASK_END * tasks * levels(ranks) + results * (ranks - 1) / ranks)


def between_hosts(cells, ranks):
    """Of all that domains' ranks hand to other hosts."""
    sent = levels(math.ceil(ranks / HOST_RANKS)) * needs.host_memory(cells)
    return Traffic(math.ceil(sent / TO_ALL), sent)


def counting(folder):
    """Words for mpirun by which Open MPI counts the messages of each rank into a folder."""
    values = {"pml": "^cm,ucx", "pml_monitoring_enable": "2", "pml_monitoring_enable_output": "3",
              "pml_monitoring_filename": folder / "sent"}
    return [word for name, value in values.items() for word in ("--mca", name, value)]


def counted(folder):
    """Of the rank that sent most messages, and the bytes of the one that sent most of these."""
    ranks = []
    for path in Path(folder).glob("sent.*.prof"):
        found = re.findall(r"(?m)^[EI]\t\d+\t\d+\t(\d+) bytes\t(\d+) msgs sent", path.read_text())
        ranks.append([sum(int(pair[k]) for pair in found) for k in (1, 0)])
    return Traffic(*map(max, zip(NONE, *ranks)))
