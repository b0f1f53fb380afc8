"""A mesh as arrays, a field of colours sampled at every texel's position, a textured .glb: `field_to_glb.py [OUT.glb]`."""
import sys

import numpy as np

import lozenge

# A torus: any positions [n, 3] and triangles [m, 3] will do.
ring, tube = 96, 48
u, v = np.meshgrid(np.arange(ring) * 2 * np.pi / ring, np.arange(tube) * 2 * np.pi / tube, indexing="ij")
positions = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], -1).reshape(-1, 3).astype(np.float32)
i, j = (a.ravel() for a in np.meshgrid(np.arange(ring), np.arange(tube), indexing="ij"))
a, b, c, d = (((i + s) % ring) * tube + (j + t) % tube for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)))
triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])


def field(places):
    """Linear colours at places [..., 3]."""
    return 0.5 + 0.5 * np.sin(4 * places)


map = lozenge.parameterize(positions, triangles)
image = map.sample(33).geometry_image
maps = lozenge.bake(map, image, ["normal"], size=512)
places = map.correspondence(512, image).interpolate(triangles, positions)
maps["base-color"] = field(places)
print(lozenge.export(sys.argv[1] if len(sys.argv) > 1 else "torus.glb", map, image, maps))
