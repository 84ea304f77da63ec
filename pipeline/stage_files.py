# SPDX-License-Identifier: AGPL-3.0-or-later
"""What binds the records of a run together, as stage_files.h, sealed_json.h and hash.h have it."""
import json
import struct

FACTOR = (1099511628211, 11400714819323198485)
START = (14695981039346656037, 1469598103934665603)


def step(total, word, factor):
    total = ((total ^ word) * factor) % 2**64
    return total ^ total >> 32


def digest(data):
    """cw_hash_bytes of all bytes at once, in hex."""
    count = len(data) // 8
    words, rest = struct.unpack_from(f"<{count}Q", data), data[8 * count:]
    a, b = START
    for place, word in enumerate(words):
        if place % 2:
            b = step(b, word, FACTOR[1])
        else:
            a = step(a, word, FACTOR[0])
    if rest:
        b = step(b, int.from_bytes(rest + bytes(7 - len(rest)) + bytes([len(rest)]), "little"), FACTOR[1])
    return f"{a:016x}{step(b, a, FACTOR[1]):016x}"


def files_digest(record):
    """Of the files of a stage, as its record tells of them."""
    files = json.dumps(record.get("files", {}), ensure_ascii=False, separators=(",", ":"), sort_keys=True)
    return digest(files.encode())


def of_export(export):
    """What a flow that was solved on the export of this record is made from."""
    return {"export": files_digest(export)}


def sealed(record):
    """The text of a record with its own digest."""
    text = json.dumps(record, indent=2).removesuffix("\n}")
    return f'{text},\n  "digest": "{digest(text.encode())}"\n}}\n'
