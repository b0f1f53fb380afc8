#!/usr/bin/env python3
"""Reads NAME.gim.exr and NAME.gim.json by docs/format.md alone, with nothing but Python's own library, and rebuilds the
watertight mesh of every level of detail.

    read_geometry_image.py NAME.gim.exr EULER      fails unless each level is oriented, ends nowhere but on the diagonals
                                                   of half patches, and has that characteristic
"""
import itertools, json, struct, sys, zlib


def headers(data):
    """The attributes of every part, by name, as raw bytes; and where the chunk tables start."""
    at, parts = 8, []
    while data[at] != 0:
        part = {}
        while data[at] != 0:
            name, kind = data[at:at + 600].split(b"\0", 2)[:2]
            at += len(name) + len(kind) + 2
            (size,) = struct.unpack_from("<i", data, at)
            part[name.decode()] = data[at + 4:at + 4 + size]
            at += 4 + size
        parts.append(part)
        at += 1
        if not data[5] & 0x10:  # not multi-part: one header, and no empty one behind it
            return parts, at
    return parts, at + 1


def unzip(packed, size):
    """One tile's bytes: deflated, as differences, low half of the byte pairs first."""
    if len(packed) == size:
        return packed
    flat = bytes(itertools.accumulate(zlib.decompress(packed), lambda a, b: (a + b - 128) & 255))
    half = (size + 1) // 2
    out = bytearray(size)
    out[0::2], out[1::2] = flat[:half], flat[half:]
    return bytes(out)


def read_levels(path):
    """The JSON, and [level][patch] -> positions, as 12 bytes each, row by row: sample (i, j) is at j * n + i. A level has
    the patches whose first level it isn't finer than."""
    data = open(path, "rb").read()
    multi = bool(data[5] & 0x10)
    parts, table = headers(data)
    levels = []
    info = json.load(open(path[:-len(".exr")] + ".json"))
    for number, part in enumerate(parts):
        n = info["levels"][number]["samples"]
        tiles = [None] * sum(first <= number for first in first_levels(info))
        for _ in range(info["levels"][number]["height"] // n * info["columns"]):
            (chunk,) = struct.unpack_from("<Q", data, table)
            table += 8
            if multi:
                assert struct.unpack_from("<i", data, chunk)[0] == number
                chunk += 4
            x, y, _, _, size = struct.unpack_from("<5i", data, chunk)
            # A row holds N.X of all its samples, then N.Y, N.Z, P.X, P.Y, P.Z, and in some files `cap`.
            channels = 7 if b"cap\0" in part["channels"] else 6
            raw = unzip(data[chunk + 20:chunk + 20 + size], n * n * channels * 4)
            value = lambda j, channel, i: raw[((j * channels + channel) * n + i) * 4:][:4]
            if y * info["columns"] + x < len(tiles):
                tiles[y * info["columns"] + x] = [
                    value(j, 3, i) + value(j, 4, i) + value(j, 5, i) for j in range(n) for i in range(n)]
        levels.append((n, tiles))
    return info, levels


def first_levels(info):
    """[patch] the finest level that has it."""
    return info.get("firstLevels", [0] * info["patches"])


def shown(levels, info, level):
    """[patch] -> (samples a side, positions), as they are drawn on a level: a patch that begins later, as it begins."""
    for patch, first in enumerate(first_levels(info)):
        n, tiles = levels[max(level, first)]
        yield n, tiles[patch]


def mesh(info, patches):
    """Triangles whose corners are positions: samples of equal bits are one vertex."""
    for (_, _, _, _, right, _), (n, tile) in zip(info["places"], patches):
        for j, i in itertools.product(range(n - 1), repeat=2):
            a, b, c, d = tile[j * n + i], tile[j * n + i + 1], tile[(j + 1) * n + i], tile[(j + 1) * n + i + 1]
            if right >= 0 or i < j:
                yield from ((a, b, c), (d, c, b))
            elif i == j:
                yield a, d, c


def diagonals(info, patches):
    """Where the surface ends: from each sample on the diagonal of a half patch to the next."""
    for (_, _, _, _, right, _), (n, tile) in zip(info["places"], patches):
        if right < 0:
            yield from ((tile[i * n + i], tile[(i + 1) * n + i + 1]) for i in range(n - 1))
            beyond = (tile[j * n + i] for j in range(n) for i in range(j + 1, n))
            assert all(sample == bytes(12) for sample in beyond), "a sample beyond the boundary is not zero"


def main(path, euler):
    info, levels = read_levels(path)
    assert info["kind"] == "geometry image" and info["version"] in (1, 2)
    for p, sides in enumerate(info["adjacency"]):
        for side, other in enumerate(sides):
            assert other < 0 or info["adjacency"][other // 4][other % 4] == 4 * p + side, "adjacency is not reciprocal"
    for (_, _, _, _, right, _), sides in zip(info["places"], info["adjacency"]):
        assert [side < 0 for side in sides] == [right < 0, right < 0, False, False], "the surface ends across a wrong side"
    firsts = first_levels(info)
    assert firsts == sorted(firsts) and all(0 <= first < len(levels) for first in firsts), "first levels are not in order"
    for first, sides in zip(firsts, info["adjacency"]):
        assert all(firsts[side // 4] == first for side in sides if side >= 0), "patches that touch begin on other levels"
    if "bodies" in info:
        owners = info["bodyOf"]
        assert len(owners) == info["patches"] and all(-1 <= owner < len(info["bodies"]) for owner in owners)
        assert all(len(place["placement"]) == 16 for body in info["bodies"] for place in body["places"])
        for owner, sides in zip(owners, info["adjacency"]):
            assert all(owners[side // 4] == owner for side in sides if side >= 0), "bodies touch"
        print(f"{len(info['bodies'])} bodies in {sum(owner >= 0 for owner in owners)} patches")
    for level, (n, _) in enumerate(levels):
        patches = list(shown(levels, info, level))
        triangles = list(mesh(info, patches))
        sides = [(t[k], t[k - 2]) for t in triangles for k in range(3)]
        known = set(sides)
        vertices = {corner for t in triangles for corner in t}
        assert len(known) == len(sides), f"{n} samples a side: a side is there twice"
        ends = {(a, b) for a, b in sides if (b, a) not in known}
        assert ends == set(diagonals(info, patches)), f"{n} samples a side: it ends elsewhere than on diagonals"
        found = len(vertices) - (len(sides) + len(ends)) // 2 + len(triangles)
        assert found == euler, f"{n} samples a side: Euler characteristic {found}, not {euler}"
        edge = f"{len(ends)} sides on the boundary" if ends else "closed"
        print(f"{n} samples a side: {len(vertices)} vertices, {len(triangles)} triangles, {edge}, characteristic {found}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
