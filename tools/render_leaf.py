#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a run: the scan coloured by its distance to the surface, and the surface with its mesh of curves.

    tools/render_leaf.py RUN OUT.png

RUN holds surface.ply and deviation.ply (output.formats with ply). Needs python3-numpy and python3-matplotlib.
"""
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

WIDTH, HEIGHT = 1100, 460
TYPES = {"double": "<f8", "float": "<f4", "int": "<i4", "uchar": "u1"}


def read_ply(path):
    """Vertex columns by name, and triangles (none: an empty array), of a binary PLY as frond writes it."""
    with open(path, "rb") as file:
        fields, counts, element = [], {}, None
        while (line := file.readline().decode().split())[0] != "end_header":
            if line[0] == "element":
                element = line[1]
                counts[element] = int(line[2])
            elif line[0] == "property" and element == "vertex":
                fields.append((line[2], TYPES[line[1]]))
        vertices = np.frombuffer(file.read(counts["vertex"] * np.dtype(fields).itemsize), fields)
        corners = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
        faces = np.frombuffer(file.read(counts.get("face", 0) * corners.itemsize), corners)
    return vertices, faces["corners"]


def points_of(vertices):
    return np.stack([vertices["x"], vertices["y"], vertices["z"]], axis=1)


def view_of(points):
    """Rotation into the picture: the long direction to the right, seen from 35 degrees above the blade."""
    centre = points.mean(axis=0)
    axes = np.linalg.svd(points - centre, full_matrices=False)[2]
    axes[2] = np.cross(axes[0], axes[1])
    tilt = np.radians(35)
    turn = np.array([[1, 0, 0], [0, np.cos(tilt), np.sin(tilt)], [0, -np.sin(tilt), np.cos(tilt)]])
    return centre, turn @ axes


def to_pixels(points, centre, rotation, scale):
    local = (points - centre) @ rotation.T * scale
    return np.stack([WIDTH / 2 + local[:, 0], HEIGHT / 2 - local[:, 1], local[:, 2]], axis=1)


def draw_triangles(corners, values, image, depth):
    """A z-buffer: values (triangle × corner × channel) are interpolated over each triangle."""
    for triangle, value in zip(corners, values):
        low = np.maximum(np.floor(triangle[:, :2].min(axis=0)).astype(int), 0)
        high = np.minimum(np.ceil(triangle[:, :2].max(axis=0)).astype(int), [WIDTH - 1, HEIGHT - 1])
        x, y = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
        (x0, y0), (x1, y1), (x2, y2) = triangle[:, :2]
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if abs(area) < 1e-9:
            continue
        b = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
        c = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
        weights = np.stack([1 - b - c, b, c])
        z = np.tensordot(triangle[:, 2], weights, 1)
        drawn = (weights.min(axis=0) >= -1e-6) & (z > depth[y, x])
        depth[y[drawn], x[drawn]] = z[drawn]
        image[y[drawn], x[drawn]] = np.tensordot(weights, value, (0, 0))[drawn]


def surface_image(vertices, triangles, pixels, rotation):
    normals = np.stack([vertices["nx"], vertices["ny"], vertices["nz"]], axis=1) @ rotation.T
    light = np.abs(normals @ np.array([-0.35, 0.55, 0.76]))
    values = np.stack([light, vertices["s"], vertices["t"]], axis=1)
    image = np.full((HEIGHT, WIDTH, 3), np.nan)
    depth = np.full((HEIGHT, WIDTH), -np.inf)
    draw_triangles(pixels[triangles], values[triangles], image, depth)
    return image, depth


def shaded(image):
    """Green by light, darker on curves of constant u and v, white outside."""
    shade = (0.25 + 0.75 * image[..., 0])[..., None] * np.array([0.62, 0.80, 0.52])
    s, t = image[..., 1], image[..., 2]
    for parameter in (s, t):
        cell = np.floor(parameter * 16)
        line = np.zeros(cell.shape, bool)
        line[:, 1:] |= cell[:, 1:] != cell[:, :-1]
        line[1:, :] |= cell[1:, :] != cell[:-1, :]
        shade[line] *= 0.62
    return np.where(np.isnan(image[..., :1]), 1, np.clip(shade, 0, 1))


def main(run, out):
    vertices, triangles = read_ply(f"{run}/surface.ply")
    scan, _ = read_ply(f"{run}/deviation.ply")
    cloud = points_of(scan)
    deviation = scan[scan.dtype.names[3]]
    centre, rotation = view_of(cloud)
    extent = np.ptp((cloud - centre) @ rotation.T, axis=0)
    scale = 0.94 * min(WIDTH / extent[0], HEIGHT / extent[1])
    image, depth = surface_image(vertices, triangles, to_pixels(points_of(vertices), centre, rotation, scale), rotation)
    surface = shaded(image)

    limit = np.percentile(np.abs(deviation), 99)
    colours = plt.get_cmap("coolwarm")(0.5 + 0.5 * np.clip(deviation / limit, -1, 1))[:, :3]
    over = surface.copy()
    pixels = to_pixels(cloud, centre, rotation, scale)
    column, row = np.rint(pixels[:, 0]).astype(int), np.rint(pixels[:, 1]).astype(int)
    inside = (column >= 0) & (column < WIDTH) & (row >= 0) & (row < HEIGHT)  # far outliers are not
    column, row, height, colours = column[inside], row[inside], pixels[inside, 2], colours[inside]
    seen = height > depth[row, column] - 0.01 * WIDTH
    for down in (0, 1, 2):
        for right in (0, 1, 2):
            over[np.minimum(row[seen] + down, HEIGHT - 1), np.minimum(column[seen] + right, WIDTH - 1)] = colours[seen]

    figure, panels = plt.subplots(1, 2, figsize=(14, 3.6), dpi=100)
    for panel, picture, title in zip(
        panels, (over, surface), ("the scan over the surface, coloured by distance", "the surface, with curves of u and v")
    ):
        panel.imshow(picture, interpolation="antialiased")
        panel.set_title(title, fontsize=11)
        panel.axis("off")
    bar = plt.cm.ScalarMappable(plt.Normalize(-limit, limit), "coolwarm")
    figure.colorbar(bar, ax=panels[0], orientation="horizontal", fraction=0.05, pad=0.02, label="mm")
    figure.colorbar(bar, ax=panels[1], orientation="horizontal", fraction=0.05, pad=0.02).ax.set_visible(False)
    figure.savefig(out, bbox_inches="tight", facecolor="white")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
