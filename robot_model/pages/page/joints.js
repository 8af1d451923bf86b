// SPDX-License-Identifier: BSD-3-Clause
// The tree of links with a slider for each variable, and what is known of the state that is shown.
'use strict';

swept.joints = (function () {
  const data = swept.data, tree = data.tree, playback = swept.playback;
  const kinematics = swept.kinematics;
  const byId = (id) => document.getElementById(id);
  const sliders = []; // {variable, range, number}
  const followers = []; // {joint, text}: those that follow another one

  function make(tag, className, parent, text) {
    const element = document.createElement(tag);
    element.className = className;
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }

  const current = () => playback.state.values || kinematics.valuesAt(playback.state.time);

  function change(variable, value) {
    if (!Number.isFinite(value)) return;
    const values = current().slice();
    values[variable] = value;
    playback.setValues(values);
  }

  // To what was typed, but no farther than a limit.
  function changeTo(variable, text) {
    const about = tree.variables[variable], value = text === '' ? NaN : Number(text);
    const low = about.lower === null ? -Infinity : about.lower;
    const high = about.upper === null ? Infinity : about.upper;
    if (!Number.isFinite(value)) return show(playback.state);
    if (value < low || value > high)
      swept.notice(about.name + ' is limited to ' + low.toFixed(4) + ' to ' + high.toFixed(4));
    return change(variable, Math.min(high, Math.max(low, value)));
  }

  function input(type, variable, row) {
    const about = tree.variables[variable], element = make('input', '', row);
    element.type = type;
    element.step = 'any';
    if (type === 'range') {
      const [low, high] = kinematics.range(about);
      element.min = low;
      element.max = high;
      element.step = (high - low) / 1000 || 1e-3;
    }
    element.setAttribute('aria-label', about.name + (about.unit ? ', ' + about.unit : ''));
    return element;
  }

  function addSlider(variable, parent) {
    const about = tree.variables[variable], row = make('div', 'slider', parent);
    make('span', 'name', row, about.name);
    const range = input('range', variable, row), number = input('number', variable, row);
    make('span', 'amount', row, about.unit);
    range.addEventListener('input', () => change(variable, Number(range.value)));
    number.addEventListener('change', () => changeTo(variable, number.value));
    sliders.push({variable: variable, range: range, number: number});
  }

  function addJoint(joint, parent) {
    if (joint.mimic) {
      const text = make('p', 'follower', parent);
      followers.push({joint: joint, text: text});
    } else if (joint.variable === null) {
      make('p', 'follower', parent, joint.name + ': fixed');
    } else {
      const count = {planar: 3, floating: 7}[joint.type] || 1;
      for (let i = 0; i < count; ++i) addSlider(joint.variable + i, parent);
    }
  }

  function addLink(link, parent) {
    const body = data.bodies.findIndex((b) => b.kind === 'link' && b.name === tree.links[link]);
    const name = make(body < 0 ? 'span' : 'button', 'link-name', parent, tree.links[link]);
    if (body >= 0) name.addEventListener('click', () => swept.panel.pick(body));
    else name.title = 'no collision geometry';
    const children = tree.joints.filter((joint) => joint.parent === link);
    if (children.length > 0) addChildren(children, make('ul', '', parent));
  }
  function addChildren(joints, list) {
    for (const joint of joints) {
      const item = make('li', '', list);
      addJoint(joint, item);
      addLink(joint.child, item);
    }
  }

  // Of the piece of the path that a moment is in.
  function pieceText(time) {
    const at = data.locate(time), motion = data.motions[at.index], tiers = motion.pieces.tiers;
    const piece = Math.min(tiers.length - 1, Math.floor(at.t * tiers.length));
    if (tiers[piece] === 'collision') return 'in a part that is in collision';
    if (tiers[piece] === 'violation') return 'in a part that is off a constraint';
    if (tiers[piece] === 'undecided') return 'undecided';
    const lower = motion.pieces.lower[piece];
    return 'free' + (lower === null ? ', no pair to check' : ', keeps ' + data.millimetres(lower) + ' or more');
  }
  function momentText(time) {
    const at = data.locate(time);
    return data.isTimed ? data.momentText(data.motions[at.index], at.t)
                        : 'path point ' + (time / data.duration).toFixed(3);
  }
  function knownText(time) {
    if (data.isPath)
      return momentText(time) + ': ' + pieceText(time);
    const state = data.states[data.locate(time).index];
    const least = state.clearance === null || state.clearance === undefined
        ? '' : ', \u2265 ' + data.millimetres(state.clearance);
    return state.label + ': ' + (state.verdict === 'free' ? 'free' + least
        : state.verdict === 'violation' ? 'off a constraint' : state.verdict || 'not judged');
  }

  function byHandText(values) {
    const known = kinematics.nearestKnown(values);
    // Beside bodies that move, what is known of a configuration is known at another time.
    if (known === null || data.moving.length > 0) return 'moved by hand: not checked';
    if (known.amount < 1e-9) return 'as at ' + knownText(known.time);
    const variable = tree.variables[known.variable];
    return 'moved by hand: not checked. The nearest that is, with ' + variable.name + ' ' +
        known.amount.toFixed(3) + (variable.unit ? ' ' + variable.unit : '') + ' away, is ' +
        knownText(known.time);
  }

  function toneOf(text) {
    if (/^moved by hand/.test(text)) return 'plain';
    if (/collision|off a constraint/.test(text.split(': ').pop())) return 'bad';
    return /: free/.test(text) ? 'good' : /undecided/.test(text) ? 'unsure' : 'plain';
  }

  function show(state) {
    const values = current();
    for (const slider of sliders) {
      const value = values[slider.variable];
      slider.range.value = value;
      slider.number.value = value.toFixed(4);
    }
    for (const follower of followers) {
      const mimic = follower.joint.mimic;
      follower.text.textContent = follower.joint.name + ': ' +
          kinematics.jointValue(follower.joint, values).toFixed(4) + ', follows ' + mimic.joint;
    }
    const none = !data.isPath && data.states.length === 0;
    const text = state.values ? byHandText(state.values) : none ? '' : 'as at ' + knownText(state.time);
    byId('now').textContent = text;
    byId('now').dataset.tone = toneOf(text);
    byId('joints-back').hidden = !state.values;
  }

  function build() {
    const moved = new Set(tree.joints.map((joint) => joint.child));
    const list = byId('tree');
    addChildren(tree.joints.filter((joint) => joint.parent === null), list);
    tree.links.forEach((name, link) => { if (!moved.has(link)) addLink(link, make('li', '', list)); });
    byId('joints-back').addEventListener('click', () => playback.setTime(playback.state.time));
    playback.onChange(show);
  }

  return {build};
})();
