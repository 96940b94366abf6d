// Two presets in the shape of the server's, for tests of the page's pure modules.
const real = (...values) => values.map((re) => ({ re, im: 0 }));

const rotor = { tau: 0, curve: 'linear', dead_zone: 0 };
/** What a preset says of the machine beyond the paper's model. */
export const MACHINE = {
  place_rotors: false,
  rotors: { pitch: rotor, yaw: rotor },
  friction: { pitch: { coulomb: 0 }, yaw: { coulomb: 0 } },
  rotor_poles: real(-15, -16),
};
const weights = {
  states: { theta: 1 / 0.17453292519943295 ** 2, psi: 1 / 0.17453292519943295 ** 2, theta_dot: 1, psi_dot: 1 },
  inputs: { V_p: 1 / 24 ** 2, V_y: 1 / 15 ** 2 },
  integrals: { theta: 1 / 0.08726646259971647 ** 2, psi: 1 / 0.08726646259971647 ** 2 },
};
const usual = {
  weights,
  coupling: 'triangular',
  lead: 'pitch',
  outer: 'pi',
  pairing: 'diagonal',
  decoupler: false,
  ...MACHINE,
};

export const PRESETS = [
  {
    name: 'quanser-2dof-manual',
    title: 'Manual',
    source: '',
    rig: 'helicopter',
    parameters: { K_pp: 0.204, B_y: 0.318, m: 1.3872 },
    limits: { V_p: 24, V_y: 15 },
    poles: real(-12, -10, -9.25, -8.76),
    ...usual,
    loops: { pitch: { kp: 30, ti: 0.1 }, yaw: { kp: 30, ti: 0.1 } },
    scenario: { reference: { theta: 0.17453292519943295, psi: 0.3490658503988659 }, duration: 3 },
  },
  {
    name: 'quanser-aero',
    title: 'Aero',
    source: '',
    rig: 'aero',
    parameters: { K_pp: 0.001, B_y: 0.002 },
    limits: { V_p: 24, V_y: 24 },
    poles: real(-3, -2.5, -2, -1.5),
    ...usual,
    coupling: 'axis-decoupled',
    lead: 'yaw',
    loops: { pitch: { kp: 5, ti: 2 }, yaw: { kp: 6, ti: 2.5 } },
    scenario: { reference: { theta: 0.1, psi: 0.2 }, duration: 20 },
  },
];
export const KNOWN = { presets: PRESETS, methods: [{ name: 'full-rank' }, { name: 'tits-yang' }, { name: 'lqr' }] };
