// A layered drawing of steps and ways: layers from the first step on, few crossings, long ways bent around boxes.

export interface Box {
  id: number;
  x: number;
  y: number;
}

export interface Point {
  x: number;
  y: number;
}

export interface Line {
  from: number;
  to: number;
  points: Point[];
}

export interface Drawing {
  boxes: Map<number, Box>;
  lines: Line[];
  width: number;
  height: number;
}

export const kBoxWidth = 150;
export const kBoxHeight = 46;
const kColumn = 34; // between boxes
const kRow = 44; // between layers
const kBendWidth = 16; // a long way's room in a layer

interface Node {
  id: number; // a step, or -1 for a bend
  layer: number;
  order: number;
  x: number;
  up: Node[];
  down: Node[];
}

interface Chain {
  from: number;
  to: number;
  reversed: boolean;
  nodes: Node[];
}

type Pair = [number, number];

/** Ways that lead back in a walk from the first step on. */
function backWays(ids: number[], out: Map<number, number[]>): Set<string> {
  const back = new Set<string>();
  const state = new Map<number, number>();
  const walk = (id: number): void => {
    state.set(id, 1);
    for (const to of out.get(id) ?? []) {
      if (state.get(to) === 1) back.add(`${id}>${to}`);
      else if (!state.has(to)) walk(to);
    }
    state.set(id, 2);
  };
  for (const id of ids) if (!state.has(id)) walk(id);
  return back;
}

/** Each step below all that lead to it. */
function layersOf(ids: number[], ways: Pair[]): Map<number, number> {
  const layer = new Map(ids.map((id) => [id, 0]));
  for (let round = 0; round < ids.length; ++round) {
    let changed = false;
    for (const [from, to] of ways) {
      const least = layer.get(from)! + 1;
      if (layer.get(to)! < least) {
        layer.set(to, least);
        changed = true;
      }
    }
    if (!changed) break;
  }
  return layer;
}

function makeChains(pairs: Pair[], back: Set<string>, nodes: Map<number, Node>, layers: Node[][]): Chain[] {
  return pairs.map(([from, to]) => {
    const reversed = back.has(`${from}>${to}`);
    const top = nodes.get(reversed ? to : from)!;
    const bottom = nodes.get(reversed ? from : to)!;
    const chain: Node[] = [top];
    for (let layer = top.layer + 1; layer < bottom.layer; ++layer) {
      const bend: Node = { id: -1, layer, order: 0, x: 0, up: [], down: [] };
      layers[layer].push(bend);
      chain.push(bend);
    }
    chain.push(bottom);
    for (let i = 0; i + 1 < chain.length; ++i) {
      chain[i].down.push(chain[i + 1]);
      chain[i + 1].up.push(chain[i]);
    }
    return { from, to, reversed, nodes: chain };
  });
}

function median(values: number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = Math.floor(sorted.length / 2);
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

function crossings(layers: Node[][]): number {
  let count = 0;
  for (const layer of layers) {
    const ends = layer.flatMap((node) => node.down.map((to) => [node.order, to.order] as Pair));
    for (let i = 0; i < ends.length; ++i)
      for (let j = 0; j < i; ++j)
        if ((ends[i][0] - ends[j][0]) * (ends[i][1] - ends[j][1]) < 0) ++count;
  }
  return count;
}

/** Sweeps down and up; each node goes to the median of its neighbours. Keeps the best order seen. */
function untangle(layers: Node[][]): void {
  const number = (): void => layers.forEach((layer) => layer.forEach((node, i) => (node.order = i)));
  number();
  let best = layers.map((layer) => [...layer]);
  let least = crossings(layers);
  for (let sweep = 0; sweep < 16 && least > 0; ++sweep) {
    const down = sweep % 2 === 0;
    for (const layer of down ? layers : [...layers].reverse()) {
      const wish = new Map(layer.map((node) => {
        const near = down ? node.up : node.down;
        return [node, near.length ? median(near.map((n) => n.order)) : node.order];
      }));
      layer.sort((a, b) => wish.get(a)! - wish.get(b)! || a.order - b.order);
      layer.forEach((node, i) => (node.order = i));
    }
    const now = crossings(layers);
    if (now < least) {
      least = now;
      best = layers.map((layer) => [...layer]);
    }
  }
  best.forEach((layer, i) => (layers[i] = layer));
  number();
}

const widthOf = (node: Node): number => (node.id < 0 ? kBendWidth : kBoxWidth);
const distance = (a: Node, b: Node): number =>
  (widthOf(a) + widthOf(b)) / 2 + (a.id < 0 || b.id < 0 ? kBendWidth : kColumn);

/** Moves a layer's nodes towards their wishes without changing their order or letting them touch. */
function settle(layer: Node[], wish: (node: Node) => number): void {
  const groups: { nodes: Node[]; offset: number[]; at: number }[] = [];
  for (const node of layer) {
    let group = { nodes: [node], offset: [0], at: wish(node) };
    for (;;) {
      const last = groups[groups.length - 1];
      if (!last) break;
      const tail = last.nodes[last.nodes.length - 1];
      const gap = distance(tail, group.nodes[0]);
      if (last.at + last.offset[last.offset.length - 1] + gap <= group.at) break;
      groups.pop();
      const shift = last.offset[last.offset.length - 1] + gap;
      const nodes = [...last.nodes, ...group.nodes];
      const offset = [...last.offset, ...group.offset.map((o) => o + shift)];
      const mean = nodes.reduce((sum, n, i) => sum + wish(n) - offset[i], 0) / nodes.length;
      group = { nodes, offset, at: mean };
    }
    groups.push(group);
  }
  for (const group of groups) group.nodes.forEach((node, i) => (node.x = group.at + group.offset[i]));
}

function place(layers: Node[][]): void {
  for (const layer of layers) {
    let x = 0;
    layer.forEach((node, i) => {
      if (i) x += distance(layer[i - 1], node);
      node.x = x;
    });
    layer.forEach((node) => (node.x -= x / 2));
  }
  for (let round = 0; round < 12; ++round) {
    const down = round % 2 === 0;
    for (const layer of down ? layers : [...layers].reverse()) {
      settle(layer, (node) => {
        const near = down ? node.up : node.down;
        return near.length ? median(near.map((n) => n.x)) : node.x;
      });
    }
  }
}

function lineOf(chain: Chain, y: (layer: number) => number): Line {
  const points: Point[] = [];
  chain.nodes.forEach((node, i) => {
    const top = y(node.layer);
    if (i === 0) points.push({ x: node.x, y: top + kBoxHeight });
    else if (i === chain.nodes.length - 1) points.push({ x: node.x, y: top });
    else points.push({ x: node.x, y: top }, { x: node.x, y: top + kBoxHeight });
  });
  if (chain.reversed) points.reverse();
  return { from: chain.from, to: chain.to, points };
}

/** Ways to a step itself are not drawn here; `pairs` must not repeat. */
export function layOut(ids: number[], pairs: Pair[]): Drawing {
  const real = pairs.filter(([from, to]) => from !== to);
  const out = new Map<number, number[]>(ids.map((id) => [id, []]));
  for (const [from, to] of real) out.get(from)!.push(to);
  const back = backWays(ids, out);
  for (const [from, to] of real) if (to === 0) back.add(`${from}>${to}`); // POWER_UP stands above all
  const forward = real.map(([from, to]): Pair => (back.has(`${from}>${to}`) ? [to, from] : [from, to]));
  const layer = layersOf(ids, forward);
  const layers: Node[][] = Array.from({ length: Math.max(0, ...layer.values()) + 1 }, () => []);
  const nodes = new Map<number, Node>();
  for (const id of ids) {
    const node: Node = { id, layer: layer.get(id)!, order: 0, x: 0, up: [], down: [] };
    nodes.set(id, node);
    layers[node.layer].push(node);
  }
  const chains = makeChains(real, back, nodes, layers);
  untangle(layers);
  place(layers);

  const all = layers.flat();
  const left = Math.min(...all.map((node) => node.x - widthOf(node) / 2));
  const right = Math.max(...all.map((node) => node.x + widthOf(node) / 2));
  const margin = 24;
  for (const node of all) node.x += margin - left;
  const y = (at: number): number => margin + at * (kBoxHeight + kRow);
  const boxes = new Map<number, Box>();
  for (const [id, node] of nodes) boxes.set(id, { id, x: node.x - kBoxWidth / 2, y: y(node.layer) });
  return {
    boxes,
    lines: chains.map((chain) => lineOf(chain, y)),
    width: right - left + 2 * margin,
    height: y(layers.length - 1) + kBoxHeight + margin,
  };
}

/** Smooth through all points, upright at each. */
export function pathOf(points: Point[]): string {
  let path = `M${points[0].x} ${points[0].y}`;
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]];
    const bend = (b.y - a.y) / 2;
    path += a.x === b.x ? `L${b.x} ${b.y}` : `C${a.x} ${a.y + bend} ${b.x} ${b.y - bend} ${b.x} ${b.y}`;
  }
  return path;
}
