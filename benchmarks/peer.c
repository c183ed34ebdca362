/* A compiled peer for comparison: the matrix method, written the direct way.
 *
 * Per gear: one solution for the speeds, one for the torques without losses, one more
 * with the ratio changed by 1 % for each mechanism (the sign of its power flow), one
 * with losses. Each is a dense Gauss elimination with partial pivoting. There are no
 * checks: it takes each gear to have exactly one solution.
 *
 *     cc -O3 -march=native -o peer peer.c -lm        (C11)
 *     peer CASE          all tables with three decimals
 *     peer CASE 0        all tables with 17 digits
 *     peer CASE N        N variants, each ratio times 1 + 1e-6*(i mod 1000), i = 1..N;
 *                        prints the sum of Mx with losses in the first gear and of the
 *                        efficiency in the last one
 *
 * CASE is a text of numbers, written by peer.py, which states their order.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST, SECOND, THIRD };
enum { ALIGN = 64, VECTOR = 4 }; /* bytes; doubles to which rows are filled up */

#define INLINE static inline __attribute__((always_inline))

typedef struct {
    int links, elements, mechanisms, gears;
    int torques;                 /* elements + mechanisms + 1: the last is Mx */
    int *ends[2];                /* by element: its two links, 0 is the housing */
    int *members[3];             /* by mechanism: its three links */
    double *ratio, *efficiency, *planet;
    int *engaged_count, **engaged; /* by gear */
} Case;

typedef struct { /* by gear and row */
    double *speeds, *planet_speeds, *slips, *torques, *lossy, *efficiency, *sign;
} Tables;

static void fail(const char *reason) {
    fprintf(stderr, "peer: %s\n", reason);
    exit(1);
}

static void *room(size_t count, size_t size) {
    size_t bytes = (count * size / ALIGN + 1) * ALIGN;
    void *memory = aligned_alloc(ALIGN, bytes);
    if (!memory) fail("out of memory");
    return memset(memory, 0, bytes);
}

static double *numbers(size_t count) { return room(count, sizeof(double)); }

/* ---- linear systems ------------------------------------------------------------- */

/* Rows of `stride` doubles; the right side stands behind the last column. Inlined into
 * one function for each stride, so that the compiler unrolls the loop over a row. */
INLINE void eliminate(int n, int stride, double *restrict rows, double *restrict x) {
    rows = __builtin_assume_aligned(rows, ALIGN);
    for (int c = 0; c < n; c++) {
        double *pivot = rows + (size_t)c * stride;
        int best = c;
        double most = fabs(pivot[c]);
        for (int r = c + 1; r < n; r++) {
            double size = fabs(rows[(size_t)r * stride + c]);
            if (size > most) most = size, best = r;
        }
        int from = c & -VECTOR;
        if (best != c) {
            double *other = rows + (size_t)best * stride;
            for (int k = from; k < stride; k++) {
                double held = pivot[k];
                pivot[k] = other[k];
                other[k] = held;
            }
        }
        double inverse = 1 / pivot[c];
        for (int r = c + 1; r < n; r++) {
            double *row = rows + (size_t)r * stride;
            if (row[c] != 0) {
                double factor = row[c] * inverse;
                for (int k = from; k < stride; k++) row[k] -= factor * pivot[k];
            }
        }
    }
    for (int r = n - 1; r >= 0; r--) {
        const double *row = rows + (size_t)r * stride;
        double rest = row[n];
        for (int k = r + 1; k < n; k++) rest -= row[k] * x[k];
        x[r] = rest / row[r];
    }
}

static int stride_of(int n) { return (n + VECTOR) / VECTOR * VECTOR; } /* n + 1, filled up */

static void gauss(int n, double *rows, double *x) {
    switch (stride_of(n)) {
        case 4: eliminate(n, 4, rows, x); break;
        case 8: eliminate(n, 8, rows, x); break;
        case 12: eliminate(n, 12, rows, x); break;
        case 16: eliminate(n, 16, rows, x); break;
        case 20: eliminate(n, 20, rows, x); break;
        case 24: eliminate(n, 24, rows, x); break;
        default: eliminate(n, stride_of(n), rows, x);
    }
}

/* ---- the method ------------------------------------------------------------------ */

static void solve_speeds(const Case *c, int gear, const double *u, double *rows, double *x) {
    int n = c->links, stride = stride_of(n), r = 0;
    memset(rows, 0, sizeof(double) * n * stride);
    for (int m = 0; m < c->mechanisms; m++, r++) {
        double share[3] = {1, -u[m], u[m] - 1};
        for (int k = FIRST; k <= THIRD; k++)
            if (c->members[k][m]) rows[r * stride + c->members[k][m] - 1] += share[k];
    }
    for (int k = 0; k < c->engaged_count[gear]; k++, r++) {
        int element = c->engaged[gear][k];
        rows[r * stride + c->ends[FIRST][element] - 1] += 1;
        if (c->ends[SECOND][element]) rows[r * stride + c->ends[SECOND][element] - 1] -= 1;
    }
    rows[r * stride] = 1; /* the input turns at speed 1 */
    rows[r * stride + n] = 1;
    gauss(n, rows, x);
}

static void solve_torques(const Case *c, const int *open, int opened, const double *u,
                          double *rows, double *x) {
    int n = c->torques, stride = stride_of(n);
    memset(rows, 0, sizeof(double) * n * stride);
    for (int e = 0; e < c->elements; e++) { /* a row for each link: its torques balance */
        rows[(c->ends[FIRST][e] - 1) * stride + e] += 1;
        if (c->ends[SECOND][e]) rows[(c->ends[SECOND][e] - 1) * stride + e] -= 1;
    }
    for (int m = 0; m < c->mechanisms; m++) {
        double share[3] = {1, -u[m], u[m] - 1};
        for (int k = FIRST; k <= THIRD; k++)
            if (c->members[k][m])
                rows[(c->members[k][m] - 1) * stride + c->elements + m] += share[k];
    }
    rows[(c->links - 1) * stride + n - 1] = 1;
    rows[n] = 1; /* torque 1 acts on the input */
    for (int k = 0; k < opened; k++) rows[(c->links + k) * stride + open[k]] = 1;
    gauss(n, rows, x);
}

static void solve_gear(const Case *c, int gear, const double *u, const Tables *t, double *work) {
    double *speeds = t->speeds + gear * c->links;
    double *torques = t->torques + gear * c->torques, *lossy = t->lossy + gear * c->torques;
    double *sign = t->sign + gear * c->mechanisms;
    double changed[c->mechanisms], found[c->torques];
    int open[c->elements], opened = 0, mx = c->torques - 1;

    solve_speeds(c, gear, u, work, speeds);
    for (int e = 0; e < c->elements; e++) {
        int other = c->ends[SECOND][e];
        t->slips[gear * c->elements + e] =
            speeds[c->ends[FIRST][e] - 1] - (other ? speeds[other - 1] : 0);
        open[opened++] = e;
        for (int k = 0; k < c->engaged_count[gear]; k++)
            if (c->engaged[gear][k] == e) {
                opened--;
                break;
            }
    }
    for (int m = 0; m < c->mechanisms; m++) {
        int carrier = c->members[THIRD][m];
        double planet = isnan(c->planet[m]) ? (u[m] + 1) / 2 : c->planet[m];
        double first = c->members[FIRST][m] ? speeds[c->members[FIRST][m] - 1] : 0;
        t->planet_speeds[gear * c->mechanisms + m] =
            carrier ? (first - speeds[carrier - 1]) / planet : 0;
    }
    solve_torques(c, open, opened, u, work, torques);
    memcpy(changed, u, sizeof changed);
    for (int m = 0; m < c->mechanisms; m++) {
        changed[m] = u[m] * .99;
        solve_torques(c, open, opened, changed, work, found);
        sign[m] = fabs(found[mx]) > fabs(torques[mx]) ? -1 : 1;
        changed[m] = u[m];
    }
    for (int m = 0; m < c->mechanisms; m++)
        changed[m] = sign[m] > 0 ? u[m] * c->efficiency[m] : u[m] / c->efficiency[m];
    solve_torques(c, open, opened, changed, work, lossy);
    t->efficiency[gear] = lossy[mx] / torques[mx];
}

static void solve(const Case *c, const double *u, const Tables *t, double *work) {
    for (int gear = 0; gear < c->gears; gear++) solve_gear(c, gear, u, t, work);
}

/* ---- reading and printing --------------------------------------------------------- */

static FILE *input;

static double number(void) {
    double value;
    if (fscanf(input, "%lf", &value) != 1) fail("expected a number");
    return value;
}

static int *integers(int count) {
    int *made = room(count, sizeof(int));
    for (int k = 0; k < count; k++) made[k] = (int)number();
    return made;
}

static double *reals(int count) {
    double *made = numbers(count);
    for (int k = 0; k < count; k++) made[k] = number();
    return made;
}

static Case read_case(const char *path) {
    Case c;
    input = fopen(path, "r");
    if (!input) fail("cannot open the case");
    c.links = (int)number();
    c.elements = (int)number();
    c.mechanisms = (int)number();
    int planets = (int)number();
    c.torques = c.elements + c.mechanisms + 1;
    for (int k = FIRST; k <= SECOND; k++) c.ends[k] = integers(c.elements);
    for (int k = FIRST; k <= THIRD; k++) c.members[k] = integers(c.mechanisms);
    c.ratio = reals(c.mechanisms);
    c.efficiency = reals(c.mechanisms);
    int *which = integers(planets);
    double *given = reals(planets);
    c.planet = numbers(c.mechanisms);
    for (int m = 0; m < c.mechanisms; m++) c.planet[m] = NAN;
    for (int k = 0; k < planets; k++) c.planet[which[k] - 1] = given[k];
    c.gears = (int)number();
    c.engaged_count = integers(c.gears);
    c.engaged = room(c.gears, sizeof(int *));
    for (int gear = 0; gear < c.gears; gear++) {
        int count = c.engaged_count[gear];
        if (c.mechanisms + count + 1 != c.links) fail("a gear without exactly one solution");
        c.engaged[gear] = integers(count);
        for (int k = 0; k < count; k++) c.engaged[gear][k]--;
    }
    fclose(input);
    return c;
}

static Tables new_tables(const Case *c) {
    return (Tables){
        .speeds = numbers(c->gears * c->links),
        .planet_speeds = numbers(c->gears * c->mechanisms),
        .slips = numbers(c->gears * c->elements),
        .torques = numbers(c->gears * c->torques),
        .lossy = numbers(c->gears * c->torques),
        .efficiency = numbers(c->gears),
        .sign = numbers(c->gears * c->mechanisms),
    };
}

static void print(const char *name, const double *table, int rows, int gears, const char *form) {
    puts(name);
    for (int r = 0; r < rows; r++) {
        for (int gear = 0; gear < gears; gear++) printf(form, table[gear * rows + r]);
        putchar('\n');
    }
}

static void report(const Case *c, const Tables *t, const char *form) {
    print("W", t->speeds, c->links, c->gears, form);
    print("WSAT", t->planet_speeds, c->mechanisms, c->gears, form);
    print("WFRI", t->slips, c->elements, c->gears, form);
    print("AMLG", t->torques, c->torques, c->gears, form);
    print("AMLGP", t->lossy, c->torques, c->gears, form);
    print("ETA", t->efficiency, 1, c->gears, form);
    print("IX", t->sign, c->mechanisms, c->gears, "%3.0f");
}

int main(int count, char **words) {
    if (count < 2) fail("usage: peer CASE [N]");
    Case c = read_case(words[1]);
    Tables t = new_tables(&c);
    int most = c.links > c.torques ? c.links : c.torques;
    double *work = numbers((size_t)most * stride_of(most));
    long variants = count > 2 ? atol(words[2]) : 0;
    if (variants == 0) {
        solve(&c, c.ratio, &t, work);
        report(&c, &t, count > 2 ? " %.17g" : "%8.3f");
        return 0;
    }
    double sum = 0, u[c.mechanisms];
    for (long i = 1; i <= variants; i++) {
        for (int m = 0; m < c.mechanisms; m++) u[m] = c.ratio[m] * (1 + 1e-6 * (i % 1000));
        solve(&c, u, &t, work);
        sum += t.lossy[c.torques - 1] + t.efficiency[c.gears - 1];
    }
    printf("check %.14e\n", sum);
    return 0;
}
