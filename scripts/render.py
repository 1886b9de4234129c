# SPDX-License-Identifier: MPL-2.0
"""Pictures of triangle meshes and balls, by numpy: orthographic, with ambient occlusion.

A scene is drawn into a buffer of samples (depth, normal, colour), several a pixel; light() shades
the samples that are seen, over() lays a glassy surface above another picture, and strip() sets
panels side by side, with titles and colour bars. Lengths are in Å until they become pixels. Needs
numpy and Pillow.
"""

import numpy as np
from PIL import Image, ImageDraw, ImageFont

FINE = 3  # samples a pixel and axis
MARGIN = 2.0  # around the molecule [Å]
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
INK = (40, 44, 52)

KEY = np.array([-0.45, 0.60, 0.66])  # to the light, in the frame of the picture
KEY = KEY / np.linalg.norm(KEY)
EYE = np.array([0.0, 0.0, 1.0])


def directions(count):
    """Unit vectors, evenly over the sphere (a Fibonacci lattice)."""
    z = 1 - (2 * np.arange(count) + 1) / count
    angle = np.arange(count) * np.pi * (3 - np.sqrt(5))
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)


class View:
    """The frame of a picture: the molecule's long axis level, its shortest one toward the eye."""

    def __init__(self, points, scale, radius=0.0, tilt=-25.0):
        self.scale = scale  # pixels per Å
        self.centre = (points.min(axis=0) + points.max(axis=0)) / 2
        axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
        axes *= np.where(np.take_along_axis(  # the signs of an SVD are arbitrary
            axes, np.abs(axes).argmax(axis=1)[:, None], axis=1) < 0, -1, 1)
        axes[2] = np.cross(axes[0], axes[1])
        c, s = np.cos(np.radians(tilt)), np.sin(np.radians(tilt))
        self.axes = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ axes
        turned = self.turn(points)
        self.low = turned.min(axis=0) - radius - MARGIN
        self.high = turned.max(axis=0) + radius + MARGIN
        self.width, self.height = (
            np.ceil((self.high - self.low)[:2] * scale).astype(int) * FINE)

    def turn(self, points):
        return (points - self.centre) @ self.axes.T

    def turn_normals(self, normals):
        return normals @ self.axes.T


class Picture:
    """Samples of what is nearest to the eye."""

    def __init__(self, view):
        self.view = view
        count = view.width * view.height
        self.depth = np.full(count, -np.inf)
        self.normal = np.zeros((count, 3), np.float32)
        self.color = np.ones((count, 3), np.float32)
        self.solid = []  # points of everything drawn, for the shadows

    def put(self, points, normals, colors):
        """Points in the view's frame; each sample keeps the one nearest to the eye."""
        view = self.view
        x, y = ((points[:, :2] - view.low[:2]) * view.scale * FINE).astype(int).T
        place = (view.height - 1 - y) * view.width + x
        near = points[:, 2] > self.depth[place]
        place, points, normals, colors = place[near], points[near], normals[near], colors[near]
        order = np.argsort(points[:, 2], kind="stable")  # of equal places the last one stays
        self.depth[place[order]] = points[order, 2]
        self.normal[place[order]] = normals[order]
        self.color[place[order]] = colors[order]

    def mesh(self, points, normals, triangles, colors):
        """Every triangle that faces the eye, sampled more densely than the picture."""
        points, normals = self.view.turn(points), self.view.turn_normals(normals)
        self.solid.append(points)
        a, b, c = (points[triangles[:, k]] for k in range(3))
        facing = np.cross(b - a, c - a)[:, 2] > 0
        edges = np.stack([b - a, c - b, a - c])[:, :, :2]
        longest = np.sqrt((edges ** 2).sum(axis=2)).max(axis=0) * self.view.scale * FINE
        steps = np.ceil(longest / 0.7).astype(int)
        for n in np.unique(steps[facing]):
            chosen = triangles[facing & (steps == n)]
            corners = [array[chosen] for array in (points, normals, colors)]
            for i in range(n + 1):
                for j in range(n + 1 - i):
                    weight = np.array([i, j, n - i - j])[:, None] / n
                    self.put(*((array * weight).sum(axis=1) for array in corners))

    def balls(self, centres, radii, colors):
        view, step = self.view, 1 / (self.view.scale * FINE)
        some = directions(200)
        for centre, radius, color in zip(view.turn(centres), radii, colors):
            low, high = ((centre[:2] + side * radius - view.low[:2]) / step for side in (-1, 1))
            x, y = np.meshgrid(*(np.arange(int(a), int(b) + 1) + 0.5 for a, b in zip(low, high)))
            x, y = (view.low[0] + x * step - centre[0]), (view.low[1] + y * step - centre[1])
            inside = x * x + y * y < radius * radius
            x, y = x[inside], y[inside]
            offset = np.stack([x, y, np.sqrt(radius * radius - x * x - y * y)], axis=1)
            self.put(centre + offset, offset / radius, np.tile(color, (len(x), 1)))
            self.solid.append(centre + radius * some)

    def positions(self, seen):
        view = self.view
        y, x = np.divmod(np.flatnonzero(seen), view.width)
        flat = np.stack([x + 0.5, view.height - y - 0.5], axis=1) / (view.scale * FINE)
        return np.column_stack([flat + view.low[:2], self.depth[seen]])

    def openness(self, seen, count=160, cell=0.5, gap=0.9):
        """For each sample seen, the share of the sky above it that nothing hides, cosine-weighted.

        For each direction the solid's points make a map of heights; what lies more than `gap` [Å]
        below the map is hidden.
        """
        solid = np.concatenate(self.solid)
        points = self.positions(seen) + 0.3 * self.normal[seen]
        light, total = np.zeros(len(points)), np.zeros(len(points))
        for toward in directions(count):
            cosine = self.normal[seen] @ toward
            above = cosine > 0
            across = np.cross(toward, [0, 0, 1] if abs(toward[2]) < 0.9 else [1, 0, 0])
            across /= np.linalg.norm(across)
            frame = np.stack([across, np.cross(toward, across), toward])
            turned = solid @ frame.T
            low = turned.min(axis=0)[:2] - 2
            size = ((turned.max(axis=0)[:2] + 2 - low) / cell).astype(int) + 1
            top = np.full(size[0] * size[1], -np.inf)
            x, y = ((turned[:, :2] - low) / cell).astype(int).T
            order = np.argsort(turned[:, 2])
            top[(x * size[1] + y)[order]] = turned[order, 2]
            mine = points[above] @ frame.T
            x, y = np.clip(((mine[:, :2] - low) / cell).astype(int), 0, size - 1).T
            light[above] += cosine[above] * (mine[:, 2] > top[x * size[1] + y] - gap)
            total[above] += cosine[above]
        return light / np.maximum(total, 1e-9)

    def light(self, flat=0.0):
        """The colours, shaded; `flat` from 0 to 1 takes away that much of the shadows."""
        seen = np.isfinite(self.depth)
        normal = self.normal[seen]
        normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
        open_sky = self.openness(seen)
        half = (KEY + EYE) / np.linalg.norm(KEY + EYE)
        lit = np.clip(normal @ KEY, 0, 1)
        shine = 0.16 * (1 - flat) * np.clip(normal @ half, 0, 1) ** 40 * open_sky
        shade = (0.18 + 0.82 * open_sky ** 0.8) * (0.70 + 0.40 * lit)
        shade += flat * (1 - shade)
        color = np.ones_like(self.color)
        color[seen] = self.color[seen] * shade[:, None] + shine[:, None]
        return np.clip(color * self.outline()[:, None], 0, 1)

    def outline(self, jump=2.5):
        """Darker where the depth jumps by more than `jump` [Å]."""
        view = self.view
        depth = self.depth.reshape(view.height, view.width)
        depth = np.where(np.isfinite(depth), depth, view.low[2] - 10)
        behind = np.zeros_like(depth)
        for axis in (0, 1):
            for step in (-1, 1):
                behind = np.maximum(behind, np.roll(depth, step, axis) - depth)
        edge = behind > jump
        for axis in (0, 1):
            edge |= np.roll(edge, 1, axis)
        return 1 - 0.55 * edge.ravel()

    def fresnel(self):
        """How opaque glass looks: more where it is seen at a slant."""
        seen = np.isfinite(self.depth)
        slant = 1 - np.abs(self.normal[:, 2])
        return np.where(seen, 0.30 + 0.60 * slant ** 2, 0)


def pixels(view, color):
    """Means over the samples of each pixel, as a picture."""
    image = color.reshape(view.height // FINE, FINE, view.width // FINE, FINE, 3)
    return Image.fromarray(np.rint(255 * image.mean(axis=(1, 3))).astype(np.uint8))


def over(above, opacity, below):
    return opacity[:, None] * above + (1 - opacity[:, None]) * below


def ramp(stops, low, high):
    """A function from values to colours; `stops` are evenly spaced colours of 0 to 1."""
    stops = np.asarray(stops, float)
    places = np.linspace(low, high, len(stops))
    return lambda values: np.stack(
        [np.interp(values, places, stops[:, k]) for k in range(3)], axis=-1)


def bar(width, title, colors, low, high, ticks):
    """A colour bar with its range, to stand below a panel."""
    image = Image.new("RGB", (width, 74), "white")
    draw = ImageDraw.Draw(image)
    font = ImageFont.truetype(FONT, 17)
    left, right = width // 2 - 150, width // 2 + 150
    values = np.linspace(low, high, right - left)
    strip_of = np.rint(255 * np.tile(colors(values), (16, 1, 1))).astype(np.uint8)
    image.paste(Image.fromarray(strip_of), (left, 26))
    draw.rectangle([left - 1, 25, right, 42], outline=INK)
    draw.text((width // 2, 10), title, INK, font, anchor="mm")
    for value, text in ticks:
        x = left + (value - low) / (high - low) * (right - left - 1)
        draw.line([x, 42, x, 47], INK)
        draw.text((x, 58), text, INK, font, anchor="mm")
    return image


def strip(path, panels, titles=(), bars=(), gap=24):
    """Panels side by side, titles below them if any, and colour bars: one for all, or one or None
    for each."""
    font = ImageFont.truetype(FONT, 19)
    high = max(panel.height for panel in panels)
    under = high + (36 if titles else 8)
    width = sum(panel.width for panel in panels) + gap * (len(panels) - 1)
    image = Image.new("RGB", (width, under + max((one.height for one in bars if one), default=0)),
                      "white")
    draw, left = ImageDraw.Draw(image), 0
    for i, panel in enumerate(panels):
        image.paste(panel, (left, (high - panel.height) // 2))
        middle = left + panel.width // 2
        if titles:
            draw.text((middle, high + 16), titles[i], INK, font, anchor="mm")
        if len(bars) == len(panels) and bars[i]:
            image.paste(bars[i], (middle - bars[i].width // 2, under))
        left += panel.width + gap
    if bars and len(bars) != len(panels):
        image.paste(bars[0], ((width - bars[0].width) // 2, under))
    coarser = np.minimum((np.asarray(image).astype(int) + 2) // 5 * 5, 255)  # packs better
    Image.fromarray(coarser.astype(np.uint8)).save(path, optimize=True)
