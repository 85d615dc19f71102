/* What a careful hand gets out of one core without a library: the units of all ratios.
   A model has S states, A actions and K successors: next[S][A][K], prob[S][A][K].  Its A and K are known at run time
   only, as they are to any library. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Synchronous value iteration from V = 0 until a sweep changes no value by more than tol; r[S][A] is the expected
   reward.  Fills V[S] and returns the number of sweeps. */
long value_iteration(long S, int A, int K, const int32_t *next, const double *prob, const double *r,
                     double gamma, double tol, double *V) {
    double *from = V, *to = malloc(S * sizeof(double)), change = INFINITY;
    long sweeps = 0;
    memset(from, 0, S * sizeof(double));
    for (; change > tol; sweeps++) {
        change = 0;
        for (long s = 0; s < S; s++) {
            double best = -1e300;
            for (int a = 0; a < A; a++) {
                long first = (s * A + a) * K;
                double v = 0;
                for (int k = 0; k < K; k++) v += prob[first + k] * from[next[first + k]];
                best = fmax(best, r[s * A + a] + gamma * v);
            }
            change = fmax(change, fabs(best - from[s]));
            to[s] = best;
        }
        double *swap = from;
        from = to, to = swap;
    }
    if (from != V) memcpy(V, from, S * sizeof(double));
    free(from == V ? to : from);
    return sweeps;
}

static inline uint64_t draw(uint64_t *state) { /* splitmix64, Steele et al., OOPSLA 2014 */
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

static inline int first_best(const double *q, int A) {
    int best = 0;
    for (int a = 1; a < A; a++)
        if (q[a] > q[best]) best = a;
    return best;
}

/* Q-learning on the two tables that this robot needs: next[S][A] and reward[S][A] of the steering that is applied, which
   is one notch off with probability slip.  One random number a step; of equal actions the first; the best action found
   for the target is the next greedy one.  Fills Q[S][A] and returns the number of steps. */
long q_learning(long S, int A, const int32_t *next, const double *reward, const uint8_t *terminal, const int64_t *start,
                long starts, double gamma, double slip, long episodes, double alpha, double epsilon, int max_steps,
                uint64_t seed, double *Q) {
    uint32_t explore = epsilon * (1 << 24), slips = slip * (1 << 20);
    long steps = 0;
    memset(Q, 0, S * A * sizeof(double));
    for (long e = 0; e < episodes; e++) {
        long s = start[(draw(&seed) >> 32) * starts >> 32];
        int greedy = first_best(Q + s * A, A);
        for (int t = 0; t < max_steps && !terminal[s]; t++, steps++) {
            uint64_t u = draw(&seed);
            int a = (u & 0xffffff) < explore ? (int)((u >> 24 & 0xffff) * A >> 16) : greedy, applied = a;
            uint32_t luck = u >> 44;
            if (luck < slips) applied += luck < slips / 2 ? -(a > 0) : a < A - 1;
            long i = s * A + applied, s_next = next[i];
            greedy = first_best(Q + s_next * A, A);
            Q[s * A + a] += alpha * (reward[i] + gamma * Q[s_next * A + greedy] - Q[s * A + a]);
            s = s_next;
        }
    }
    return steps;
}
