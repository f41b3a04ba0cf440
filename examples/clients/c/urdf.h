/* The chain of a URDF from its root to a link, and where that link is. No XML library: the lab's
 * URDFs have one element a tag and quote their attributes with ". */
#ifndef URDF_H
#define URDF_H

enum { URDF_JOINTS = 32, URDF_NAME = 96 };

typedef struct {
    char name[URDF_NAME], parent[URDF_NAME], child[URDF_NAME];
    char kind[16]; /* revolute, continuous, prismatic, fixed */
    double xyz[3], rpy[3], axis[3];
    double position; /* rad or m */
} urdf_joint;

typedef struct {
    urdf_joint joints[URDF_JOINTS]; /* from the root to the tip */
    int count;
} urdf_chain;

/* Read the chain to the link `tip`; 0 where the URDF has no such link. */
int urdf_read(urdf_chain *chain, const char *text, const char *tip);

/* Set the position of the joint called `name`; one that is not in the chain is ignored. */
void urdf_move(urdf_chain *chain, const char *name, double position);

/* Compute T_root_tip, 3 rows of 4. */
void urdf_forward(const urdf_chain *chain, double pose[3][4]);

#endif
