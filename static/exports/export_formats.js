/**
 * The files that `POST api/v1/export/{format}` makes, in the menu's order. Pure.
 * @typedef {{name: string, label: string, filename: string, about: string, opens?: boolean}} Export
 */

/** @type {{group: string, formats: Export[]}[]} */
export const EXPORTS = [
  {
    group: 'Scripts',
    formats: [
      {
        name: 'python',
        label: 'Python',
        filename: 'heli2dof_design.py',
        about: 'rig, gain, loops and step response with python-control',
      },
      {
        name: 'matlab',
        label: 'MATLAB',
        filename: 'heli2dof_design.m',
        about: 'the same, and the nonlinear rig, in plain matrices, for MATLAB and Octave',
      },
    ],
  },
  {
    group: 'Controller in C',
    formats: [
      {
        name: 'c-source',
        label: '.c',
        filename: 'heli2dof_controller.c',
        about: 'C99, float or double, one step function; needs its header',
      },
      {
        name: 'c-header',
        label: '.h',
        filename: 'heli2dof_controller.h',
        about: 'the header, with how it is discretized',
      },
    ],
  },
  {
    group: 'Numbers',
    formats: [
      {
        name: 'csv',
        label: 'CSV',
        filename: 'heli2dof_responses.csv',
        about: 'both axes stepped together, by both models, every state',
      },
      {
        name: 'mat',
        label: '.mat',
        filename: 'heli2dof_data.mat',
        about: 'matrices and responses for MATLAB and Octave',
      },
      {
        name: 'json',
        label: 'JSON',
        filename: 'heli2dof_design.json',
        about: 'everything that the server says of the design',
      },
    ],
  },
  {
    group: 'Lab report',
    formats: [
      {
        name: 'report',
        label: 'HTML',
        filename: 'heli2dof_report.html',
        about: 'two pages to print: formulas, plots, figures of merit, findings, pinned designs, room for answers',
        opens: true,
      },
    ],
  },
];
