/** What the section on the paper says between the formulas: for each chapter what is done, why, and what to look at. */

/** @type {Record<string, string>} */
export const MARKS = { reproduced: '✓', corrected: '≠', explained: 'i' };

/** @type {Record<string, string>} */
export const MEANINGS = {
  reproduced: 'the paper’s formula, derived again, is the same',
  corrected: 'printed and derived differ; both are shown, with a proof',
  explained: 'not in the paper, or lost in our copy',
};

/** @type {{name: string, title: string, text: string, look: string}[]} */
export const CHAPTERS = [
  {
    name: 'machine',
    title: 'The machine',
    text:
      'A beam with a propeller at each end stands on a post, free to pitch and to turn. The front propeller ' +
      'lifts, the tail propeller pushes sideways, and the drag of each also turns the other’s axis: this crosstalk ' +
      'makes the rig one plant with two inputs and two outputs rather than two plants with one of each. Eqs. 1 and ' +
      '8 turn what can be weighed and measured into the centre of mass and the four thrust constants.',
    look:
      'Compare K_py with K_pp, and K_yp with K_yy: the tail hardly lifts the nose, but the main propeller ' +
      'turns the rig noticeably.',
  },
  {
    name: 'mechanics',
    title: 'Mechanics',
    text:
      'Two energies are all that is put in. The velocity of the centre of mass and the two inertias give the ' +
      'kinetic energy (Eq. 2); its height gives the potential energy (Eq. 3). Lagrange’s equations (Eq. 4) turn ' +
      'both into the equations of motion (Eq. 9), with motors and friction as generalized forces (Eq. 6). ' +
      'Everything further down this page, $A$, $B$ and $K$ included, follows from these lines.',
    look:
      'The mass matrix contains cos²$θ$: with its nose up or down the rig turns more easily. The Coriolis and ' +
      'centrifugal torques of Eq. 11 come from that one dependence.',
  },
  {
    name: 'linear',
    title: 'Linear model',
    text:
      'Near rest at $θ$₀ the equations of motion are replaced by their tangent, $ẋ = Ax + Bu$. Rest has its ' +
      'price: the motors hold the beam against gravity all the time, and $x$ and $u$ count from that trim.',
    look:
      'Pitch and yaw do not meet in $A$; they meet in $B$ only, through the crosstalk. The slips sit here: ' +
      'whose damping stands in the last row of $A$, and whose inertia divides which row of $B$.',
  },
  {
    name: 'feedback',
    title: 'State feedback',
    text:
      'The feedback $u = −Kx + v$ moves the four poles. The way to $K$ is a change of coordinates. If the pair ' +
      '$(A, B)$ is controllable, $T$ brings it to Luenberger’s canonical form, in which each input drives a chain ' +
      'of two integrators and the coefficients of the desired polynomials can be written straight into their rows. ' +
      '$K̄$ is read off there, and $K = Q⁻¹K̄T$ brings it back (Eq. 19). Two inputs and four poles leave a choice; ' +
      'the paper’s makes the closed loop triangular.',
    look:
      '$T(A − BK)T$⁻¹, under Eq. 18: each diagonal block carries the coefficients of its own pair, and in the ' +
      'paper’s structure the block above the diagonal is zero.',
  },
  {
    name: 'interaction',
    title: 'Interaction',
    text:
      'Before a loop is closed around each angle, one asks which voltage should command which angle, and how ' +
      'much the two loops will feel each other. The relative gain array compares a channel’s gain while the other ' +
      'loop is open with its gain while the other loop holds its angle: 1 means that the other loop does not ' +
      'matter, a negative value that the pairing is wrong.',
    look:
      'With $a$ = 0, as in the paper, $λ$₁₁ depends on the chosen poles through $p$₃$p$₄/$p$₁$p$₂ only; the ' +
      'factor before it belongs to the rig.',
  },
  {
    name: 'loops',
    title: 'The loops',
    text:
      'Two PI controllers make the angles follow their references (Fig. 3). They add two poles and move the ' +
      'four that were placed, so the desired poles alone no longer say how the rig answers. The paper ends with a ' +
      'step of one radian on each axis (Figs. 4 and 5).',
    look: 'The last curve of Fig. 4: with its voltage limits and its stop the rig never reaches the reference.',
  },
];

export const CURVES = 'Our copy has no curves. These are computed from the model and may differ from the printed ones.';
export const COPY = 'Our copy is the text without its pictures, with damaged formulas: such a slip may be the copy’s.';
