/*
 * reference.c - the same picture, drawn the plain way.
 *
 * A second, independent implementation of the image contract: a recursive
 * Whitted ray tracer in double precision that tests every ray against every
 * object of one array. It serves two purposes:
 *
 *   - correctness: its pictures must agree with the crate's to within rounding;
 *   - speed: it is what a competent programmer writes in an afternoon, compiled
 *     by an optimising compiler, and so the yardstick for the host benchmarks.
 *
 * It takes textbook formulas and one fixed epsilon throughout. Everything clever
 * belongs into the crate, not here.
 *
 *   gcc -O3 -march=native -o reference host-runner/benches/reference.c -lm
 *   ./reference SCENE OUT.ppm [WxH] [MAX_DEPTH] [REPEAT]
 *
 * WxH overrides the size in the scene ("-" keeps it), MAX_DEPTH is 5 unless
 * given, REPEAT renders several times. The CPU time of the rendering alone
 * (median of the repeats; neither loading nor writing) goes to stderr.
 */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Secondary rays start this far off the surface, along the facing normal. */
#define EPSILON 1e-9

/* ---- vectors ---------------------------------------------------------- */

typedef struct { double x, y, z; } Vec;

static inline Vec vec(double x, double y, double z) { return (Vec){ x, y, z }; }
static inline Vec add(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec sub(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec mul(Vec a, Vec b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec scale(double s, Vec a) { return vec(s * a.x, s * a.y, s * a.z); }
static inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double length(Vec a) { return sqrt(dot(a, a)); }
static inline Vec normalize(Vec a) { return scale(1.0 / length(a), a); }
static inline Vec cross(Vec a, Vec b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double clamp01(double v) { return v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v; }
static inline Vec clamp(Vec c) { return vec(clamp01(c.x), clamp01(c.y), clamp01(c.z)); }

/* ---- the scene -------------------------------------------------------- */

enum { SPHERE = 0, PLANE = 1, TRIANGLE = 2 };

typedef struct {
    Vec diffuse, specular, ambient;
    double reflection, shininess, refraction, ior;
} Material;

typedef struct {
    int kind;
    union {
        struct { Vec centre; double radius; } sphere;
        struct { Vec normal; double d; } plane;            /* normal . p + d = 0 */
        struct { Vec v1, edge1, edge2, normal; } triangle; /* edges v2-v1, v3-v1 */
    } u;
    Material material;
} Object;

typedef struct {
    Vec camera;
    int width, height;
    Vec light_position, light_specular, light_diffuse;
    double ambient;
    int sky;
    Vec background;
    int count;
    Object *objects;
    int max_depth;
} Scene;

/* ---- intersections ---------------------------------------------------- */

/* The smallest t > 0 at which the ray meets the object, or a negative number. */
static inline double intersect(const Object *object, Vec origin, Vec dir)
{
    switch (object->kind) {
    case SPHERE: {
        Vec oc = sub(origin, object->u.sphere.centre);
        double r = object->u.sphere.radius;
        double b = dot(oc, dir);
        double c = dot(oc, oc) - r * r;
        double disc = b * b - c;
        if (disc < 0.0)
            return -1.0;
        double root = sqrt(disc);
        double t = -b - root;
        return t > 0.0 ? t : -b + root;
    }
    case PLANE: {
        double nd = dot(object->u.plane.normal, dir);
        if (nd == 0.0)
            return -1.0;
        return -(dot(object->u.plane.normal, origin) + object->u.plane.d) / nd;
    }
    default: { /* TRIANGLE: Moeller and Trumbore, both sides */
        Vec e1 = object->u.triangle.edge1, e2 = object->u.triangle.edge2;
        Vec p = cross(dir, e2);
        double det = dot(e1, p);
        if (det == 0.0)
            return -1.0;
        double inv = 1.0 / det;
        Vec s = sub(origin, object->u.triangle.v1);
        double u = dot(s, p) * inv;
        if (u < 0.0 || u > 1.0)
            return -1.0;
        Vec q = cross(s, e1);
        double v = dot(dir, q) * inv;
        if (v < 0.0 || u + v > 1.0)
            return -1.0;
        return dot(e2, q) * inv;
    }
    }
}

static Vec geometric_normal(const Object *object, Vec point)
{
    switch (object->kind) {
    case SPHERE:
        return normalize(sub(point, object->u.sphere.centre));
    case PLANE:
        return object->u.plane.normal;
    default:
        return object->u.triangle.normal;
    }
}

/* The nearest object and its distance; of equally near ones the first. */
static const Object *nearest(const Scene *scene, Vec origin, Vec dir, double *distance)
{
    const Object *found = NULL;
    double best = INFINITY;
    for (int i = 0; i < scene->count; i++) {
        double t = intersect(&scene->objects[i], origin, dir);
        if (t > 0.0 && t < best) {
            best = t;
            found = &scene->objects[i];
        }
    }
    *distance = best;
    return found;
}

/* Does anything that casts shadows lie strictly between origin and the light? */
static int in_shadow(const Scene *scene, Vec origin, Vec to_light, double distance)
{
    for (int i = 0; i < scene->count; i++) {
        const Object *object = &scene->objects[i];
        if (object->material.ior == 1.0)
            continue;
        double t = intersect(object, origin, to_light);
        if (t > 0.0 && t < distance)
            return 1;
    }
    return 0;
}

/* ---- shading ---------------------------------------------------------- */

static Vec background(const Scene *scene, Vec dir)
{
    if (!scene->sky)
        return scene->background;
    double s = 0.5 * (dir.y + 1.0);
    return add(scale(1.0 - s, vec(1.0, 1.0, 1.0)), scale(s, vec(0.5, 0.7, 1.0)));
}

/* `outside` is the hit, moved off the surface; `n` the normal facing the ray. */
static Vec local_colour(const Scene *scene, const Material *m, Vec outside, Vec n, Vec dir)
{
    Vec colour = scale(scene->ambient, m->ambient);
    Vec to_light = sub(scene->light_position, outside);
    double distance = length(to_light);
    Vec l = scale(1.0 / distance, to_light);
    double nl = dot(n, l);
    /* Written so that a light exactly at the origin (0/0) counts as no light. */
    if (!(nl > 0.0) || in_shadow(scene, outside, l, distance))
        return colour;

    colour = add(colour, scale(nl, mul(scene->light_diffuse, m->diffuse)));
    Vec r = sub(scale(2.0 * nl, n), l);
    double rv = -dot(r, dir);
    if (rv > 0.0)
        colour = add(colour, scale(pow(rv, m->shininess), mul(scene->light_specular, m->specular)));
    return colour;
}

static Vec trace(const Scene *scene, Vec origin, Vec dir, int depth)
{
    double t;
    const Object *object = nearest(scene, origin, dir, &t);
    if (!object)
        return background(scene, dir);

    const Material *m = &object->material;
    Vec point = add(origin, scale(t, dir));
    Vec n = geometric_normal(object, point);
    double nd = dot(n, dir);
    int entering = nd <= 0.0;
    if (!entering) {
        n = scale(-1.0, n);
        nd = -nd;
    }
    Vec outside = add(point, scale(EPSILON, n));
    Vec colour = local_colour(scene, m, outside, n, dir);

    if (depth < scene->max_depth) {
        if (m->reflection > 0.0) {
            Vec mirrored = normalize(sub(dir, scale(2.0 * nd, n)));
            colour = add(colour, scale(m->reflection, trace(scene, outside, mirrored, depth + 1)));
        }
        if (m->refraction > 0.0) {
            Vec inside = sub(point, scale(EPSILON, n));
            if (m->ior == 1.0) { /* straight on */
                colour = add(colour, scale(m->refraction, trace(scene, inside, dir, depth + 1)));
            } else {
                double eta = entering ? 1.0 / m->ior : m->ior;
                double k = 1.0 - eta * eta * (1.0 - nd * nd);
                if (k >= 0.0) { /* else total internal reflection */
                    Vec bent = normalize(sub(scale(eta, dir), scale(eta * nd + sqrt(k), n)));
                    colour = add(colour, scale(m->refraction, trace(scene, inside, bent, depth + 1)));
                }
            }
        }
    }
    return clamp(colour);
}

/* ---- the picture ------------------------------------------------------ */

static unsigned char level(double c) { return (unsigned char)floor(255.0 * c + 0.5); }

static void render(const Scene *scene, unsigned char *rgb)
{
    int w = scene->width, h = scene->height;
    for (int j = 0; j < h; j++) {
        for (int i = 0; i < w; i++) {
            double x = (double)(2 * i + 1 - w) / h;
            double y = (double)(h - 1 - 2 * j) / h;
            Vec colour = trace(scene, scene->camera, normalize(vec(x, y, 1.0)), 0);
            *rgb++ = level(colour.x);
            *rgb++ = level(colour.y);
            *rgb++ = level(colour.z);
        }
    }
}

/* ---- reading the scene ------------------------------------------------ */

static const char *scene_name;
static int line_number;

static void fail(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fprintf(stderr, "%s:%d: ", scene_name, line_number);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
    va_end(args);
    exit(1);
}

#define MAX_FIELDS 32

typedef struct {
    int count;
    char text[1024]; /* the line itself, fields separated by zero bytes */
    const char *field[MAX_FIELDS];
} Record;

/* The next line that holds numbers; 0 at the end of the file. */
static int next_record(FILE *file, Record *record)
{
    while (fgets(record->text, sizeof record->text, file)) {
        line_number++;
        if (!strchr(record->text, '\n') && !feof(file))
            fail("line too long");
        record->text[strcspn(record->text, "#")] = '\0';
        record->count = 0;
        for (char *s = strtok(record->text, " \t\r\n"); s; s = strtok(NULL, " \t\r\n")) {
            if (record->count == MAX_FIELDS)
                fail("too many numbers");
            record->field[record->count++] = s;
        }
        if (record->count > 0)
            return 1;
    }
    return 0;
}

static void need_record(FILE *file, Record *record, int count, const char *what)
{
    if (!next_record(file, record))
        fail("the file ends before the %s", what);
    if (count > 0 && record->count != count)
        fail("%s: found %d numbers, expected %d", what, record->count, count);
}

static double number(const Record *record, int i)
{
    const char *s = record->field[i];
    char *end;
    double value = strtod(s, &end);
    if (s[strspn(s, "0123456789+-.eE")] != '\0' || *end != '\0') /* no hex, inf, nan */
        fail("'%s' is not a number", s);
    if (!isfinite(value))
        fail("'%s' is too large", s);
    return value;
}

static double number_from_0(const Record *record, int i)
{
    double value = number(record, i);
    if (value < 0.0)
        fail("'%s' must not be negative", record->field[i]);
    return value;
}

static long whole_number(const Record *record, int i, long least, long most)
{
    const char *s = record->field[i];
    if (s[strspn(s, "0123456789")] != '\0')
        fail("'%s' must be digits only", s);
    errno = 0;
    long value = strtol(s, NULL, 10);
    if (errno != 0 || value < least || value > most)
        fail("'%s' must be %ld to %ld", s, least, most);
    return value;
}

static Vec position(const Record *r, int i)
{
    return vec(number(r, i), number(r, i + 1), number(r, i + 2));
}

static Vec intensity(const Record *r, int i)
{
    return vec(number_from_0(r, i), number_from_0(r, i + 1), number_from_0(r, i + 2));
}

static void read_object(const Record *r, Object *object)
{
    static const int geometry[] = { [SPHERE] = 4, [PLANE] = 4, [TRIANGLE] = 13 };
    object->kind = (int)whole_number(r, 0, SPHERE, TRIANGLE);
    int at = 1 + geometry[object->kind];
    if (r->count != at + 13)
        fail("object: found %d numbers, expected %d", r->count, at + 13);

    switch (object->kind) {
    case SPHERE:
        object->u.sphere.centre = position(r, 1);
        object->u.sphere.radius = number(r, 4);
        if (!(object->u.sphere.radius > 0.0) || !isfinite(object->u.sphere.radius * object->u.sphere.radius))
            fail("'%s' is no radius", r->field[4]);
        break;
    case PLANE: {
        Vec n = position(r, 1);
        double len = length(n);
        if (!(len > 0.0) || !isfinite(len))
            fail("the plane's normal has no direction");
        object->u.plane.normal = scale(1.0 / len, n);
        object->u.plane.d = number(r, 4) / len;
        break;
    }
    default: {
        Vec v1 = position(r, 1);
        object->u.triangle.v1 = v1;
        object->u.triangle.edge1 = sub(position(r, 4), v1);
        object->u.triangle.edge2 = sub(position(r, 7), v1);
        for (int i = 10; i < 14; i++)
            number(r, i); /* placeholders */
        Vec n = cross(object->u.triangle.edge2, object->u.triangle.edge1);
        double len = length(n);
        if (!(len > 0.0) || !isfinite(len))
            fail("the triangle has no area");
        object->u.triangle.normal = scale(1.0 / len, n);
        break;
    }
    }

    Material *m = &object->material;
    m->diffuse = intensity(r, at);
    m->specular = intensity(r, at + 3);
    m->ambient = intensity(r, at + 6);
    m->reflection = number_from_0(r, at + 9);
    m->shininess = number_from_0(r, at + 10);
    m->refraction = number_from_0(r, at + 11);
    m->ior = number_from_0(r, at + 12);
    if (m->refraction > 0.0 && m->ior == 0.0)
        fail("refraction needs an index above 0");
}

static void read_scene(const char *name, Scene *scene)
{
    Record r;
    FILE *file = fopen(name, "r");
    scene_name = name;
    if (!file)
        fail("%s", strerror(errno));

    need_record(file, &r, 1, "number of objects");
    scene->count = (int)whole_number(&r, 0, 0, 1000000);
    need_record(file, &r, 3, "camera position");
    scene->camera = position(&r, 0);
    need_record(file, &r, 2, "image size");
    scene->width = (int)whole_number(&r, 0, 1, 65535);
    scene->height = (int)whole_number(&r, 1, 1, 65535);

    need_record(file, &r, 0, "light");
    if (r.count == 8) { /* as in the published example */
        fprintf(stderr, "%s:%d: warning: the light has 8 numbers, the last one is repeated\n", name, line_number);
        r.field[r.count++] = r.field[7];
    }
    if (r.count != 9)
        fail("light: found %d numbers, expected 9", r.count);
    scene->light_position = position(&r, 0);
    scene->light_specular = intensity(&r, 3);
    scene->light_diffuse = intensity(&r, 6);

    need_record(file, &r, 1, "ambient intensity");
    scene->ambient = number_from_0(&r, 0);
    need_record(file, &r, 1, "sky flag");
    scene->sky = (int)whole_number(&r, 0, 0, 1);
    need_record(file, &r, 3, "background colour");
    scene->background = clamp(intensity(&r, 0));

    scene->objects = calloc((size_t)scene->count + 1, sizeof *scene->objects);
    if (!scene->objects)
        fail("out of memory");
    for (int i = 0; i < scene->count; i++) {
        need_record(file, &r, 0, "last object");
        read_object(&r, &scene->objects[i]);
    }
    if (next_record(file, &r))
        fail("more than %d objects", scene->count);
    fclose(file);
}

/* ---- main ------------------------------------------------------------- */

static double cpu_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int usage(void)
{
    fprintf(stderr, "usage: reference SCENE OUT.ppm [WxH|-] [MAX_DEPTH] [REPEAT]\n");
    return 2;
}

int main(int argc, char **argv)
{
    if (argc < 3 || argc > 6)
        return usage();

    Scene scene;
    read_scene(argv[1], &scene);
    if (argc > 3 && strcmp(argv[3], "-") != 0) {
        char rest;
        if (sscanf(argv[3], "%dx%d%c", &scene.width, &scene.height, &rest) != 2 || scene.width < 1
            || scene.width > 65535 || scene.height < 1 || scene.height > 65535)
            return usage();
    }
    scene.max_depth = argc > 4 ? atoi(argv[4]) : 5;
    int repeat = argc > 5 ? atoi(argv[5]) : 1;
    if (scene.max_depth < 0 || repeat < 1)
        return usage();

    size_t pixels = (size_t)scene.width * (size_t)scene.height;
    unsigned char *rgb = malloc(3 * pixels);
    double *seconds = malloc((size_t)repeat * sizeof *seconds);
    if (!rgb || !seconds) {
        fprintf(stderr, "out of memory\n");
        return 1;
    }
    for (int i = 0; i < repeat; i++) {
        double start = cpu_seconds();
        render(&scene, rgb);
        seconds[i] = cpu_seconds() - start;
    }
    qsort(seconds, (size_t)repeat, sizeof *seconds, ascending);
    double median = 0.5 * (seconds[(repeat - 1) / 2] + seconds[repeat / 2]);
    fprintf(stderr, "%s: %dx%d, depth %d: %.3f ms CPU, %.1f ns per pixel (median of %d)\n", argv[1], scene.width,
            scene.height, scene.max_depth, 1e3 * median, 1e9 * median / (double)pixels, repeat);

    FILE *out = fopen(argv[2], "wb");
    if (!out || fprintf(out, "P6\n%d %d\n255\n", scene.width, scene.height) < 0
        || fwrite(rgb, 3, pixels, out) != pixels || fclose(out) != 0) {
        fprintf(stderr, "%s: %s\n", argv[2], strerror(errno));
        return 1;
    }
    free(rgb);
    free(seconds);
    free(scene.objects);
    return 0;
}
