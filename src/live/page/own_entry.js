// A style of one object's own, or settings of one light's own, that begin as what holds for it now.

/** What differs in the entry `old` of `kind` from what a new one would inherit, as [key, value]. */
function differences(kind, old, values, tables) {
  const defaults = new Map(
    tables.find(({ pass }) => pass === kind).parameters.map((p) => [p.name, p.default]),
  );
  const differ = (a, b) => JSON.stringify(a) !== JSON.stringify(b);
  return Object.entries(old ?? {}).flatMap(([section, settings]) =>
    Object.entries(settings)
      .filter(([name, value]) =>
        differ(value, section === kind ? defaults.get(name) : values.look[section][name]))
      .map(([name, value]) => [section === kind ? name : `${section}.${name}`, value]));
}

function entries(kind, number, given, inherited) {
  const keys = new Map([...given, ...inherited.filter(([key]) => !given.has(key))]);
  return [...keys].map(([key, value]) => [`${kind}[${number}].${key}`, JSON.stringify(value)]);
}

/** The overrides of a new style for what the probe found. `values` are the look's. */
export function ownStyle(found, values, tables) {
  const old = values.style[found.style];
  const given = new Map([['object', [found.object]]]);
  if (old) given.set('priority', old.style.priority + 1);
  const inherited = differences('style', old, values, tables);
  return entries('style', values.style.length, given,
    inherited.filter(([key]) => key !== 'material'));
}

/** Those of new settings for the light called `name`, which globs may have had some for. */
export function ownLight(name, values, tables) {
  const matches = (glob) => new RegExp(`^${glob.replace(/[.+^${}()|[\]\\]/g, '\\$&')
    .replaceAll('*', '.*').replaceAll('?', '.')}$`, 's').test(name);
  const old = values.light.findLast((light) => matches(light.light.name));
  return entries('light', values.light.length, new Map([['name', name]]),
    differences('light', old, values, tables));
}
