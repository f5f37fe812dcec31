// A light is turned round what it lights, wherever in the picture the hand takes hold: most lights
// stand outside of it.

const sweep = Math.PI; // radians for a way over the whole canvas

/** `v` turned round the unit `axis` by `angle` (Rodrigues' formula). */
function turned(v, axis, angle) {
  const [x, y, z] = axis;
  const along = (1 - Math.cos(angle)) * (v[0] * x + v[1] * y + v[2] * z);
  const cross = [y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]];
  return v.map((part, i) => part * Math.cos(angle) + cross[i] * Math.sin(angle) + axis[i] * along);
}

const spelled = (vector) => JSON.stringify(vector.map((part) => Number(part.toPrecision(6))));

/** The keys of a light after the hand went right and down by shares of the canvas. */
export function draggedLight(light, [right, up], across, down) {
  const turn = (v) => turned(turned(v, up, sweep * across), right, sweep * down);
  const keys = [];
  if (light.type !== 'sun') {
    const from = turn(light.position.map((part, i) => part - light.subject[i]));
    keys.push(['position', spelled(from.map((part, i) => part + light.subject[i]))]);
  }
  if (light.type !== 'point') keys.push(['direction', spelled(turn(light.direction))]);
  return keys;
}
