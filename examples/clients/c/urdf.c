#include "urdf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copy the attribute `name` of the element that begins at `at`; empty: it has none. */
static void attribute(const char *at, const char *end, const char *name, char *out, size_t size) {
    size_t length = strlen(name);
    out[0] = 0;
    for (const char *p = at; p + length + 2 < end && *p != '>'; p++) {
        if (p[-1] != ' ' || strncmp(p, name, length) || p[length] != '=' || p[length + 1] != '"')
            continue;
        const char *value = p + length + 2, *quote = strchr(value, '"');
        if (quote && quote < end) snprintf(out, size, "%.*s", (int)(quote - value), value);
        return;
    }
}

static void vector(const char *text, double out[3]) {
    char *next = (char *)text;
    for (int i = 0; i < 3 && *text; i++) out[i] = strtod(next, &next);
}

/* Return the element `tag` between two places, NULL where there is none. */
static const char *element(const char *at, const char *end, const char *tag) {
    char wanted[32];
    snprintf(wanted, sizeof wanted, "<%s ", tag);
    const char *found = strstr(at, wanted);
    return found && found < end ? found + 1 : NULL;
}

static const char *read_joint(const char *at, urdf_joint *joint) {
    char text[96];
    const char *end = strstr(at, "</joint>"), *inner;
    if (!end) return NULL;
    *joint = (urdf_joint){.axis = {1, 0, 0}};
    attribute(at, end, "name", joint->name, sizeof joint->name);
    attribute(at, end, "type", joint->kind, sizeof joint->kind);
    if ((inner = element(at, end, "parent"))) attribute(inner, end, "link", joint->parent, URDF_NAME);
    if ((inner = element(at, end, "child"))) attribute(inner, end, "link", joint->child, URDF_NAME);
    if ((inner = element(at, end, "origin"))) {
        attribute(inner, end, "xyz", text, sizeof text), vector(text, joint->xyz);
        attribute(inner, end, "rpy", text, sizeof text), vector(text, joint->rpy);
    }
    if ((inner = element(at, end, "axis")))
        attribute(inner, end, "xyz", text, sizeof text), vector(text, joint->axis);
    return end;
}

int urdf_read(urdf_chain *chain, const char *text, const char *tip) {
    char link[URDF_NAME];
    snprintf(link, sizeof link, "%s", tip);
    chain->count = 0;
    for (int climbing = 1; climbing;) {
        urdf_joint joint;
        climbing = 0;
        for (const char *at = text; (at = strstr(at, "<joint ")) && (at = read_joint(at + 1, &joint));) {
            if (strcmp(joint.child, link)) continue;
            if (chain->count == URDF_JOINTS) return 0;
            memmove(chain->joints + 1, chain->joints, sizeof joint * (size_t)chain->count++);
            chain->joints[0] = joint;
            snprintf(link, sizeof link, "%s", joint.parent);
            climbing = 1;
            break;
        }
    }
    return chain->count > 0;
}

void urdf_move(urdf_chain *chain, const char *name, double position) {
    for (int i = 0; i < chain->count; i++)
        if (!strcmp(chain->joints[i].name, name)) chain->joints[i].position = position;
}

static void multiply(double a[3][4], double b[3][4]) {
    double out[3][4];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            out[i][j] = j == 3 ? a[i][3] : 0;
            for (int k = 0; k < 3; k++) out[i][j] += a[i][k] * b[k][j];
        }
    memcpy(a, out, sizeof out);
}

/* R = Rz(yaw) Ry(pitch) Rx(roll), as the URDF specification has it. */
static void origin(const urdf_joint *joint, double out[3][4]) {
    double cr = cos(joint->rpy[0]), sr = sin(joint->rpy[0]), cp = cos(joint->rpy[1]);
    double sp = sin(joint->rpy[1]), cy = cos(joint->rpy[2]), sy = sin(joint->rpy[2]);
    double pose[3][4] = {{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, joint->xyz[0]},
                         {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, joint->xyz[1]},
                         {-sp, cp * sr, cp * cr, joint->xyz[2]}};
    memcpy(out, pose, sizeof pose);
}

/* Rodrigues' formula for a turn about the joint's axis, or a shift along it. */
static void motion(const urdf_joint *joint, double out[3][4]) {
    double length = sqrt(joint->axis[0] * joint->axis[0] + joint->axis[1] * joint->axis[1] +
                         joint->axis[2] * joint->axis[2]);
    double x = joint->axis[0] / length, y = joint->axis[1] / length, z = joint->axis[2] / length;
    double shift = strcmp(joint->kind, "prismatic") ? 0 : joint->position;
    double angle = strcmp(joint->kind, "prismatic") ? joint->position : 0;
    double c = cos(angle), s = sin(angle), v = 1 - c;
    double pose[3][4] = {{c + x * x * v, x * y * v - z * s, x * z * v + y * s, x * shift},
                         {y * x * v + z * s, c + y * y * v, y * z * v - x * s, y * shift},
                         {z * x * v - y * s, z * y * v + x * s, c + z * z * v, z * shift}};
    memcpy(out, pose, sizeof pose);
}

void urdf_forward(const urdf_chain *chain, double pose[3][4]) {
    double step[3][4], identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    memcpy(pose, identity, sizeof identity);
    for (int i = 0; i < chain->count; i++) {
        origin(&chain->joints[i], step);
        multiply(pose, step);
        if (strcmp(chain->joints[i].kind, "fixed")) {
            motion(&chain->joints[i], step);
            multiply(pose, step);
        }
    }
}
