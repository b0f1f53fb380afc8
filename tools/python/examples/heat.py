"""Heat spreads over a surface, computed on its geometry image: `heat.py IMAGE.npz [PICTURE.png]`.

The state is one number for each sample, in the arrays [patch, N, N]. What a sample's neighbours are across a patch's border, the table
of adjacency says, and nothing else: no mesh is welded, no position is compared. Each step is implicit (backward Euler), with linear
elements on the samples' triangles. Beside it the same is done on the source's own triangles, with the cotangent Laplacian
that everybody uses; the difference is told. IMAGE.npz: `lozenge export IMAGE.gim.exr --as npz --source IMAGE.map.glb -o IMAGE.npz`.
"""
import struct
import sys
import zlib

import numpy as np

from lozenge import data

STEPS = 10
SPREAD = 0.1  # how far heat goes in all of them, in diagonals of the box: sqrt(time)


class Elements:
    """The cotangent Laplacian and the mass of triangles whose corners are states; equal states are made so by `share`."""

    def __init__(self, positions, triangles, share):
        self.triangles, self.share, self.count = triangles, share, len(positions)
        corners = positions[triangles].astype(float)
        sides = np.roll(corners, -2, 1) - np.roll(corners, -1, 1)  # side c is across corner c
        double_area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=-1)
        is_flat = double_area <= 1e-12 * (sides ** 2).sum((1, 2))
        with np.errstate(divide="ignore", invalid="ignore"):
            cotangents = -(np.roll(sides, -1, 1) * np.roll(sides, -2, 1)).sum(-1) / double_area[:, None]
        self.weights = np.where(is_flat[:, None], 0, cotangents / 2)
        self.mass = share(self.summed(np.repeat(double_area / 6, 3).reshape(-1, 3)))

    def summed(self, values):
        return np.bincount(self.triangles.ravel(), values.ravel(), self.count)

    def stiffness(self, u):
        """What flows out of each state."""
        at = u[self.triangles]
        flow = self.weights * (np.roll(at, -2, 1) - np.roll(at, -1, 1))  # along side c, from its first end
        return self.share(self.summed(np.roll(flow, -2, 1) - np.roll(flow, -1, 1)) * -1)


def diffuse(elements, u, time, steps, once):
    """Backward Euler by conjugate gradients. `once` [state]: 1 / how many copies of it there are."""
    def apply(x):
        return elements.mass * x + time / steps * elements.stiffness(x)

    scale = 1 / np.where(elements.mass > 0, elements.mass, 1)
    for _ in range(steps):
        rest = elements.mass * u - apply(u)
        along = scale * rest
        norm = start = (once * rest * along).sum()
        while norm > 1e-16 * start and norm > 0:
            image = apply(along)
            step = norm / (once * along * image).sum()
            u, rest = u + step * along, rest - step * image
            norm, before = (once * rest * scale * rest).sum(), norm
            along = scale * rest + norm / before * along
    return u


def hot_spot(positions, centre, radius):
    return np.exp(-((positions - centre) ** 2).sum(-1) / radius ** 2)


def solve(patches):
    """(heat on the samples, heat on the source's vertices seen from the samples, their masses), each [samples]."""
    vertex, count = patches.vertices()
    there = vertex >= 0
    copies = np.bincount(vertex[there], minlength=count)

    def share(x):  # samples of one place are in several patches: each gets the sum
        return np.where(there, np.bincount(vertex[there], x[there], count)[vertex], 0)

    positions, mesh, corners = patches.flat("positions"), patches["mesh_positions"], patches["mesh_triangles"]
    diagonal = np.linalg.norm(np.ptp(mesh, axis=0))
    centre, radius, time = mesh[np.argmax(mesh[:, 1])], 0.2 * diagonal, (SPREAD * diagonal) ** 2
    grid = Elements(positions, patches.triangles(), share)
    on_grid = diffuse(grid, hot_spot(positions, centre, radius) * there, time, STEPS, np.where(there, 1 / copies[vertex], 0))
    source = Elements(mesh, corners, lambda x: x)
    on_source = diffuse(source, hot_spot(mesh, centre, radius), time, STEPS, np.ones(len(mesh)))
    at = corners[patches.flat("source_triangles")]
    return on_grid, (on_source[at] * patches.flat("source_weights")).sum(-1) * there, grid.mass * np.where(there, 1 / copies[vertex], 0)


def draw(patches, heat, path, size=480, finer=10):
    """Splats of a surface that is refined linearly until they leave no gap, from the front, with the lines between patches."""
    values = np.concatenate([patches.flat("positions"), patches.flat("normals"), heat[:, None]], 1)
    points, begin = [], 0
    for grid in patches.grids:
        n, count = grid.side, len(grid.patches)
        block = values[begin:begin + count * n * n].reshape(count, n, n, -1)
        block = np.where(grid["mask"][..., None], block, block.transpose(0, 2, 1, 3))  # halves of patches, at a boundary
        begin += count * n * n
        at = np.linspace(0, n - 1, finer * (n - 1) + 1)
        low = np.minimum(at.astype(int), n - 2)
        part = (at - low)[:, None]
        block = block[:, low] * (1 - part[:, None]) + block[:, low + 1] * part[:, None]
        block = block[:, :, low] * (1 - part) + block[:, :, low + 1] * part
        line = np.zeros((len(at), len(at), 1))
        line[:2] = line[-2:] = line[:, :2] = line[:, -2:] = 1
        inside = grid["mask"].all((1, 2))[:, None, None] | (np.arange(len(at))[:, None] >= np.arange(len(at)))
        points.append(np.concatenate([block, np.broadcast_to(line, block.shape[:3] + (1,))], -1)[inside])
    points = np.concatenate(points)
    turn = np.array([[0.84, 0, -0.54], [-0.19, 0.94, -0.29], [0.51, 0.35, 0.79]])
    place = points[:, :3] @ turn.T
    points = points[np.argsort(place[:, 2])]
    low, high = place.min(0)[:2], place.max(0)[:2]
    x, y = ((points[:, :3] @ turn[:2].T - (low + high) / 2) * [1, -1] * 1.84 * size / (high - low).max() + size).astype(int).T
    light = 0.45 + 0.55 * np.clip(points[:, 3:6] @ turn.T @ [0.3, 0.5, 0.81], 0, 1)
    ramp = [60, 90, 245, 255], [80, 160, 190, 240], [150, 150, 70, 190]
    colours = np.stack([np.interp(points[:, 6] / heat.max(), [0, 0.3, 0.65, 1], c) for c in ramp], -1)
    colours *= (light * (1 - 0.25 * points[:, 7]))[:, None]
    picture = np.full((2 * size, 2 * size, 3), 255.0)
    splat = np.array([0, 1])
    picture[(y[:, None, None] + splat[:, None]), (x[:, None, None] + splat)] = colours[:, None, None]
    picture = picture.reshape(size, 2, size, 2, 3).mean((1, 3)).astype(np.uint8)
    rows = np.concatenate([np.zeros((size, 1), np.uint8), picture.reshape(size, -1)], 1)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def main():
    patches = data.load(sys.argv[1])
    heat, reference, mass = solve(patches)
    error = np.sqrt((mass * (heat - reference) ** 2).sum() / (mass * reference ** 2).sum())
    print(f"{int((mass > 0).sum())} samples, {len(patches['mesh_positions'])} source vertices: "
          f"{100 * error:.2f} % apart (L2), {100 * np.abs(heat - reference).max() / reference.max():.2f} % at most")
    if len(sys.argv) > 2:
        draw(patches, heat, sys.argv[2])


if __name__ == "__main__":
    main()
