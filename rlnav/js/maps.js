/**
 * Maps of the book, as drawings for `GridWorld.fromAscii`, and random ones.
 * Mirrors rlnav/maps.py; `randomWorld` is its `random`.
 */
import { integer, number } from "./check.js";
import { generator } from "./rng.js";
import { GridWorld, LARGEST_SIDE, reachable } from "./world.js";

export const FREE_SPACE = `
..........
..........
.......G..
..........
..........
..........
..........
..S.......
..........
..........
`;

export const OBSTACLES = `
..........
.......#G.
..##...#..
...#...#..
...#......
.....##...
.##...#...
..........
.S...#....
..........
`;

export const ROOMS = `
.....#.....
.....#..G..
...........
.....#.....
.....#.....
#.####.....
.....###.##
.....#.....
.S...#.....
...........
.....#.....
`;

export const CORRIDOR = `
############
#..........#
#.########.#
#.########.#
#^########G#
############
`;

export const MAZE = `
.......#...
.####..#.#.
.#..#....#.
.#..#.####.
.#.##......
.#......##.
.########..
.........#.
.#######.#G
^..........
`;

export const CLIFF = `
............
............
............
^##########G
`;

/** Draw a world whose cells are obstacles with a given chance, and put the goal into its largest open region. */
export function randomWorld(width, height = width, { density = 0.2, rng = null } = {}) {
  integer("width", width, 2, LARGEST_SIDE);
  integer("height", height, 2, LARGEST_SIDE);
  number("density", density, 0, 0.8);
  const chance = generator(rng);
  const obstacles = new Uint8Array(width * height);
  let region = [];
  while (region.length < 2) {
    for (let i = 0; i < obstacles.length; i++) obstacles[i] = chance.random() < density ? 1 : 0;
    region = largestRegion(width, height, obstacles);
  }
  const goal = region[Math.floor(chance.random() * region.length)];
  const walls = [];
  obstacles.forEach((wall, i) => wall && walls.push([i % width, Math.floor(i / width)]));
  return new GridWorld(width, height, { goal, obstacles: walls });
}

/** Cells of the largest open region, column by column; of equally large ones the one that begins last. */
function largestRegion(width, height, obstacles) {
  const done = obstacles.slice();
  let largest = [];
  for (let x = 0; x < width; x++) {
    for (let y = 0; y < height; y++) {
      if (done[y * width + x]) continue;
      const region = reachable([x, y], width, height, obstacles);
      const cells = [];
      for (let i = 0; i < width * height; i++) {
        const at = (i % height) * width + Math.floor(i / height); // column by column
        if (region[at]) cells.push([at % width, Math.floor(at / width)]);
        done[at] |= region[at];
      }
      if (cells.length >= largest.length) largest = cells;
    }
  }
  return largest;
}
