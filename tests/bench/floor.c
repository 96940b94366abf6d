/* The nonlinear response as heli2dof_core/kernels computes it, in plain C: the floor that `update.py` compares with.
 *
 * The same method line by line: Dormand and Prince's 5(4) pair, continuous output, switches bisected to the last
 * digit. Arrays are laid out as heli2dof_core/layout.py says. A test checks that both give the same numbers.
 */
#include <math.h>
#include <string.h>

enum { K_PP, K_PY, K_YP, K_YY, ALPHA, J_Y, ML2, MGL, B_P, B_Y, K_S, GAIN = 11, OFFSET = 23, LIMIT = 25, WANTED = 27,
       TRACKING = 29, TRAVEL = 33, DISTURBANCE = 34 };
enum { SIDE = 2, REST = 4, MOTOR_OF = 5, WINDUP = 7 };
enum { INSIDE, BEYOND, SLIDING };
enum { NO_ANTI_WINDUP, CLAMPING, BACK_CALCULATION };
enum { N = 6, MOST_SWITCHES = 2000 };

typedef struct { double state[N], share[2]; } Slope;

static void accelerations(double theta, double theta_dot, double psi_dot, double V_p, double V_y, const double *c,
                          double *pitch, double *yaw) {
    double s = sin(theta), co = cos(theta), sway = c[ML2] * s * co;
    *pitch = (c[K_PP] * V_p + c[K_PY] * V_y - c[B_P] * theta_dot - c[K_S] * theta
              - (sway * psi_dot * psi_dot + c[MGL] * co)) / c[ALPHA];
    *yaw = (c[K_YP] * V_p + c[K_YY] * V_y - c[B_Y] * psi_dot + 2.0 * sway * theta_dot * psi_dot)
           / (c[J_Y] + c[ML2] * co * co);
}

static double asked(const double *y, int motor, const double *c) {
    const double *row = c + GAIN + 6 * motor;
    double u = c[OFFSET + motor];
    for (int j = 0; j < N; j++) u += row[j] * y[j];
    return u;
}

static double given(double u, int motor, const double *c, const long *m) {
    return m[motor] == INSIDE ? u : (double)m[SIDE + motor] * c[LIMIT + motor];
}

static void clamp(double e0, double e1, const double *c, const long *m, Slope *k) {
    long a = m[MOTOR_OF], b = m[MOTOR_OF + 1];
    int pushes0 = m[a] != INSIDE && c[GAIN + 6 * a + 4] * e0 * (double)m[SIDE + a] > 0.0;
    int pushes1 = m[b] != INSIDE && c[GAIN + 6 * b + 5] * e1 * (double)m[SIDE + b] > 0.0;
    double share0 = m[0] == BEYOND ? 0.0 : 1.0, share1 = m[1] == BEYOND ? 0.0 : 1.0;
    if (m[0] == SLIDING || m[1] == SLIDING) {
        double k0 = 0, k1 = 0, s00 = 0, s01 = 0, s10 = 0, s11 = 0;
        for (int j = 0; j < 4; j++) {
            k0 += c[GAIN + j] * k->state[j];
            k1 += c[GAIN + 6 + j] * k->state[j];
        }
        for (int i = 0; i < 2; i++) {
            double e = i ? e1 : e0, f0 = c[GAIN + 4 + i] * e, f1 = c[GAIN + 10 + i] * e;
            int pushes = i ? pushes1 : pushes0;
            long motor = i ? b : a;
            if (!pushes) { k0 += f0; k1 += f1; }
            else if (motor == 0) { s00 += f0; s10 += f1; }
            else { s01 += f0; s11 += f1; }
        }
        if (m[0] == SLIDING && m[1] == SLIDING) {
            double det = s00 * s11 - s01 * s10;
            share0 = det != 0.0 ? (k1 * s01 - k0 * s11) / det : 2.0;
            share1 = det != 0.0 ? (k0 * s10 - k1 * s00) / det : 2.0;
        } else if (m[0] == SLIDING) share0 = s00 != 0.0 ? -(k0 + share1 * s01) / s00 : 2.0;
        else share1 = s11 != 0.0 ? -(k1 + share0 * s10) / s11 : 2.0;
    }
    k->share[0] = share0; k->share[1] = share1;
    if (pushes0) e0 *= a == 0 ? share0 : share1;
    if (pushes1) e1 *= b == 0 ? share0 : share1;
    k->state[4] = e0; k->state[5] = e1;
}

static void rates(const double *y, const double *c, const long *m, Slope *k) {
    double u0 = asked(y, 0, c), u1 = asked(y, 1, c), v0 = given(u0, 0, c, m), v1 = given(u1, 1, c, m);
    double pitch, yaw, theta_dot = y[2];
    accelerations(y[0], y[2], y[3], v0 + c[DISTURBANCE], v1 + c[DISTURBANCE + 1], c, &pitch, &yaw);
    if (m[REST] != 0) theta_dot = pitch = 0.0;
    k->state[0] = theta_dot; k->state[1] = y[3]; k->state[2] = pitch; k->state[3] = yaw;
    double e0 = c[WANTED] - y[0], e1 = c[WANTED + 1] - y[1];
    if (m[WINDUP] == CLAMPING && (m[0] != INSIDE || m[1] != INSIDE)) { clamp(e0, e1, c, m, k); return; }
    if (m[WINDUP] == BACK_CALCULATION) {
        double cut0 = v0 - u0, cut1 = v1 - u1;
        e0 += c[TRACKING] * cut0 + c[TRACKING + 1] * cut1;
        e1 += c[TRACKING + 2] * cut0 + c[TRACKING + 3] * cut1;
    }
    k->state[4] = e0; k->state[5] = e1;
}

static int watch(const double *y, const double *c, const long *m, double *g) {
    double u0 = asked(y, 0, c), u1 = asked(y, 1, c);
    Slope k;
    if (m[0] == SLIDING || m[1] == SLIDING) rates(y, c, m, &k);
    for (int motor = 0; motor < 2; motor++) {
        double limit = c[LIMIT + motor], u = motor ? u1 : u0;
        g[2 * motor + 1] = 1.0;
        if (m[motor] == SLIDING) {
            g[2 * motor] = k.share[motor];
            g[2 * motor + 1] = 1.0 - k.share[motor];
        } else if (m[motor] == INSIDE) g[2 * motor] = 1.0 - fabs(u) / limit;
        else g[2 * motor] = (double)m[SIDE + motor] * u / limit - 1.0;
    }
    if (m[REST] == 0) g[4] = c[TRAVEL] - fabs(y[0]);
    else {
        double pitch, yaw;
        accelerations(y[0], 0.0, y[3], given(u0, 0, c, m) + c[DISTURBANCE], given(u1, 1, c, m) + c[DISTURBANCE + 1], c,
                      &pitch, &yaw);
        g[4] = (double)m[REST] * pitch;
    }
    int low = 0;
    for (int j = 1; j < 5; j++) if (g[j] < g[low]) low = j;
    return g[low] < -1e-13 ? low : -1;
}

static void resolve(const double *y, const double *c, long *m) {
    for (int motor = 0; motor < 2; motor++) {
        double u = asked(y, motor, c);
        m[SIDE + motor] = u > 0.0 ? 1 : -1;
        m[motor] = fabs(u) > c[LIMIT + motor] ? BEYOND : INSIDE;
    }
}

static void leave_stop(double *y, long *m) { m[REST] = 0; y[0] *= 1.0 - 1e-12; }

static void meet_stop(double *y, const double *c, long *m, double *g) {
    m[REST] = y[0] > 0.0 ? 1 : -1;
    y[0] = (double)m[REST] * c[TRAVEL]; y[2] = 0.0;
    resolve(y, c, m);
    watch(y, c, m, g);
    if (g[4] <= 0.0) leave_stop(y, m);
}

static void change_modes(int which, double *y, const double *c, long *m, double *g) {
    int motor = which / 2;
    Slope k;
    if (which == 4) {
        if (m[REST] == 0) meet_stop(y, c, m, g);
        else leave_stop(y, m);
    } else if (m[motor] == INSIDE) {
        m[SIDE + motor] = asked(y, motor, c) > 0.0 ? 1 : -1;
        m[motor] = BEYOND;
        if (m[WINDUP] == CLAMPING) {
            double rise = 0.0;
            rates(y, c, m, &k);
            for (int j = 0; j < N; j++) rise += c[GAIN + 6 * motor + j] * k.state[j];
            if (rise * (double)m[SIDE + motor] < 0.0) m[motor] = SLIDING;
        }
    } else if (m[motor] == SLIDING) m[motor] = which % 2 == 0 ? BEYOND : INSIDE;
    else {
        m[motor] = INSIDE;
        if (m[WINDUP] == CLAMPING) {
            m[motor] = SLIDING;
            rates(y, c, m, &k);
            if (!(k.share[motor] < 1.0)) m[motor] = INSIDE;
        }
    }
}

static double first_step(const double *y, const Slope *k, double length, double rtol, double atol) {
    double size = 0.0, speed = 0.0;
    for (int i = 0; i < N; i++) {
        double scale = atol + rtol * fabs(y[i]), a = y[i] / scale, b = k->state[i] / scale;
        size += a * a; speed += b * b;
    }
    size = sqrt(size / 6); speed = sqrt(speed / 6);
    return fmin(length, fmin(size, speed) < 1e-5 ? 1e-6 : 0.01 * size / speed);
}

#define K(s) k[s].state[i]
static double attempt(const double *y, double h, Slope *k, double *trial, const double *c, const long *m, double rtol,
                      double atol) {
    for (int i = 0; i < N; i++) trial[i] = y[i] + h * (K(0) / 5);
    rates(trial, c, m, k + 1);
    for (int i = 0; i < N; i++) trial[i] = y[i] + h * (3. / 40 * K(0) + 9. / 40 * K(1));
    rates(trial, c, m, k + 2);
    for (int i = 0; i < N; i++) trial[i] = y[i] + h * (44. / 45 * K(0) - 56. / 15 * K(1) + 32. / 9 * K(2));
    rates(trial, c, m, k + 3);
    for (int i = 0; i < N; i++)
        trial[i] = y[i] + h * (19372. / 6561 * K(0) - 25360. / 2187 * K(1) + 64448. / 6561 * K(2) - 212. / 729 * K(3));
    rates(trial, c, m, k + 4);
    for (int i = 0; i < N; i++)
        trial[i] = y[i] + h * (9017. / 3168 * K(0) - 355. / 33 * K(1) + 46732. / 5247 * K(2) + 49. / 176 * K(3)
                               - 5103. / 18656 * K(4));
    rates(trial, c, m, k + 5);
    for (int i = 0; i < N; i++)
        trial[i] = y[i] + h * (35. / 384 * K(0) + 500. / 1113 * K(2) + 125. / 192 * K(3) - 2187. / 6784 * K(4)
                               + 11. / 84 * K(5));
    rates(trial, c, m, k + 6);
    double total = 0.0;
    for (int i = 0; i < N; i++) {
        double d = 71. / 57600 * K(0) - 71. / 16695 * K(2) + 71. / 1920 * K(3) - 17253. / 339200 * K(4)
                   + 22. / 525 * K(5) - 1. / 40 * K(6);
        d = h * d / (atol + rtol * fmax(fabs(y[i]), fabs(trial[i])));
        total += d * d;
    }
    return total < INFINITY ? sqrt(total / 6) : INFINITY;
}

static void interpolant(const double *y, double h, const Slope *k, const double *trial, double q[5][N]) {
    for (int i = 0; i < N; i++) {
        double change = trial[i] - y[i], bend = h * K(0) - change;
        q[0][i] = y[i]; q[1][i] = change; q[2][i] = bend;
        q[3][i] = change - h * K(6) - bend;
        q[4][i] = h * (-12715105075. / 11282082432 * K(0) + 87487479700. / 32700410799 * K(2)
                       - 10690763975. / 1880347072 * K(3) + 701980252875. / 199316789632 * K(4)
                       - 1453857185. / 822651844 * K(5) + 69997945. / 29380423 * K(6));
    }
}

static void point(double x, double q[5][N], double *out) {
    double z = 1.0 - x;
    for (int i = 0; i < N; i++) out[i] = q[0][i] + x * (q[1][i] + z * (q[2][i] + x * (q[3][i] + z * q[4][i])));
}

static int first_switch(double q[5][N], const double *c, const long *m, double *g, double *share) {
    double low = 0.0, probe[N];
    for (int half = 1; half < 3; half++) {
        double high = 0.5 * half;
        point(high, q, probe);
        int which = watch(probe, c, m, g);
        if (which >= 0) {
            while (high - low > 1e-15) {
                double middle = 0.5 * (low + high);
                if (middle <= low || middle >= high) break;
                point(middle, q, probe);
                int found = watch(probe, c, m, g);
                if (found >= 0) { high = middle; which = found; }
                else low = middle;
            }
            *share = high;
            return which;
        }
        low = high;
    }
    *share = 1.0;
    return -1;
}

/* As heli2dof_core.kernels.dormand_prince.integrate; returns the steps taken, or −1. */
long integrate(double *y, const double *t, long samples, const double *c, long *m, double rtol, double atol,
               long most_steps, double *states) {
    Slope k[7];
    double q[5][N], trial[N], g[5], now = t[0], end = t[samples - 1];
    long steps = 0, switches = 0, done = 1;
    resolve(y, c, m);
    if (fabs(y[0]) >= c[TRAVEL]) meet_stop(y, c, m, g);
    rates(y, c, m, k);
    double h = first_step(y, k, end - now, rtol, atol);
    memcpy(states, y, sizeof(double) * N);
    while (done < samples) {
        steps++;
        h = fmin(h, end - now);
        if (steps > most_steps || h < 1e-15 * end) return -1;
        double error = attempt(y, h, k, trial, c, m, rtol, atol), share;
        if (!(error <= 1.0)) { h *= error < INFINITY ? fmax(0.2, 0.9 * pow(error, -0.2)) : 0.1; continue; }
        interpolant(y, h, k, trial, q);
        int which = first_switch(q, c, m, g, &share);
        double reached = now + share * h;
        int last = end - reached < 1e-12 * end;
        while (done < samples && (t[done] <= reached || last)) {
            point(fmin((t[done] - now) / h, share), q, states + N * done);
            done++;
        }
        if (which < 0) {
            memcpy(y, trial, sizeof trial);
            k[0] = k[6];
            h *= error == 0.0 ? 5.0 : fmin(5.0, 0.9 * pow(error, -0.2));
        } else {
            if (++switches > MOST_SWITCHES) return -1;
            point(share, q, y);
            change_modes(which, y, c, m, g);
            rates(y, c, m, k);
            h *= fmax(1.0 - share, 1e-3);
        }
        now = reached;
    }
    return steps;
}
