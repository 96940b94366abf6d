% What GNU Octave's control package makes of the loops in the file `loops`: lines "name|value" for other_tools.py.
% octave-cli --no-gui --eval "loops = 'loops.mat'" --eval "source other_tools.m"
1;
pkg load control
warning('off', 'all');

function say(name, value)
  if ~ischar(value)
    value = strjoin(arrayfun(@(v) num2str(v, '%.5g'), value(:).', 'UniformOutput', false), ', ');
  end
  printf('%s|%s\n', name, value);
end

function exact(name, what)
  value = what();
  say(name, strjoin(arrayfun(@(v) num2str(v, '%.17g'), value(:).', 'UniformOutput', false), ', '));
end

function try_it(name, what)
  try
    say(name, what());
  catch e
    say(name, ['error: ' strrep(strtok(e.message, ';'), "\n", ' ')]);
  end
end

function out = margins(L)
  [gain, phase, w_gain, w_phase] = margin(L);
  out = [gain, w_gain, phase, w_phase];
end

function out = phases(L)
  [~, phase] = bode(L, [0.1, 1, 10]);
  out = phase(:);
end

function out = window(G)
  [y, t] = step(G);
  out = [t(end), numel(t), y(end)];
end

function out = last_of_impulse(dt)
  y = impulse(ss(tf([1, 1.2], [1, 3, 2])), 1, dt);
  out = y(end);
end

data = load(loops);
info = pkg('describe', 'control');
say('version', ['GNU Octave ' OCTAVE_VERSION ', control ' info{1}.version]);
for k = 1:data.count
  n = @(what) sprintf('%s%d', what, k);
  L = ss(data.(n('A')), data.(n('b')), data.(n('c')), 0);
  try_it(n('margin_ss'), @() margins(L));
  try_it(n('phase_ss'), @() phases(L));
  try_it(n('phase_tf'), @() phases(tf(data.(n('num')), data.(n('den')))));
  try_it(n('window'), @() window(ss(data.(n('Ac')), data.(n('bc')), data.(n('cc')), 0)));
  A = data.(n('Ap')); B = data.(n('Bp'));
  exact(n('place'), @() place(A, B, data.(n('poles'))).');
  exact(n('acker'), @() acker(data.(n('Aa')), data.(n('Ba')), data.(n('pa'))));
  exact(n('lqr'), @() lqr(A, B, eye(4), eye(2)).');
end
try_it('dcgain', @() dcgain(ss(data.A0, data.B0, data.C0, zeros(2))).');
try_it('dcgain_plant', @() dcgain(ss(data.Ap6, data.Bp6, eye(2, 4), zeros(2))).');

% Single calls whose result surprises
s = tf('s');
try_it('textbook', @() phases((s + 1) / s^2));
try_it('unstable_margin', @() margins(100 / ((s + 1) * (s + 2) * (s + 3))));
try_it('two_limits', @() margins((s + 1)^2 / (s^3 * (s / 20 + 1)^2)));
try_it('margin_at_zero', @() margins(2 / (s - 1)));
try_it('margin_of_ss', @() margins(ss((s + 0.1) / s^2)));
chain = diag(ones(3, 1), 1); last = [0; 0; 0; 1];
double = [zeros(2), eye(2); zeros(2, 4)]; two = [zeros(2); eye(2)];
try_it('interleaved', @() sort(eig(chain - last * place(chain, last, [-1+1i, -2+1i, -1-1i, -2-1i]))));
try_it('double', @() max(real(eig(double - two * place(double, two, [-1+1i, -1-1i, -2+1i, -2-1i])))));
try_it('uncontrollable', @() eig(diag([1, 2]) - [1; 0] * place(diag([1, 2]), [1; 0], [-1, -2])));
try_it('fewer', @() place([-5, 0; 0, -1], [1; 1], -3));
try_it('fewer_alpha', @() place([-5, 0; 0, -1], [1; 1], -3, -2));
try_it('triple', @() place(diag([1, 1], 1), [0; 0; 1], [-1, -1, -1]));
try_it('lqr_unseen', @() lqr([0, 1; 0, 0], [0; 1], diag([0, 1]), 1));
try_it('lqr_oscillator', @() lqr([0, 1; -1, 0], [0; 1], zeros(2), 1));
try_it('impulse_coarse', @() last_of_impulse(1e-3));
try_it('impulse_fine', @() last_of_impulse(5e-4));
try_it('impulse_mimo', @() impulse(ss(-eye(2), eye(2), eye(2), zeros(2)), 1));
integrating = ss([0, 0; 0, -1], [1; 1], [1, 1], 0);
try_it('dcgain_integrating', @() dcgain(integrating));
try_it('dcgain_other_basis', @() dcgain(ss([1, 2; 3, 4] * [0, 0; 0, -1] / [1, 2; 3, 4], ...
  [1, 2; 3, 4] * [1; 1], [1, 1] / [1, 2; 3, 4], 0)));
sampled = ss([0.5, 0; 0, 0.2], [1; 1], [1, 1], 0, 0.1);
try_it('ss2ss', @() [isct(ss2ss(sampled, eye(2))), isstable(sampled), isstable(ss2ss(sampled, eye(2)))]);
hidden = (s - 1) / ((s - 1) * (s + 1));
try_it('hidden', @() [isstable(hidden), isstable([hidden, 1 / (s + 2); 1 / (s + 3), 1 / (s + 4)])]);
try_it('matched', @() bode(c2d(1 / (s * (s + 1)), 0.1, 'matched'), 0.01) / bode(1 / (s * (s + 1)), 0.01));
try_it('sampled_pid', @() pole(pid(1, 2, 0, 0, 0.1)));
