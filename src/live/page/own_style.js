// A style of one object's own, that begins as what the object has now.

/** The overrides of style `number` for what the probe found. `values` are the look's. */
export function ownStyle(found, values, tables, number) {
  const entries = [['object', [found.object]]];
  const old = values.style[found.style];
  if (old) entries.push(['priority', old.style.priority + 1]);
  const defaults = new Map(
    tables.find(({ pass }) => pass === 'style').parameters.map((p) => [p.name, p.default]),
  );
  const differs = (a, b) => JSON.stringify(a) !== JSON.stringify(b);
  for (const [section, settings] of Object.entries(old ?? {}))
    for (const [name, value] of Object.entries(settings)) {
      const path = section === 'style' ? name : `${section}.${name}`;
      if (['object', 'material', 'priority'].includes(path)) continue;
      const inherited = section === 'style' ? defaults.get(name) : values.look[section][name];
      if (differs(value, inherited)) entries.push([path, value]);
    }
  return entries.map(([path, value]) => [`style[${number}].${path}`, JSON.stringify(value)]);
}
