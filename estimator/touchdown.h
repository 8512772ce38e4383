#ifndef TOUCHDOWN_TOUCHDOWN_H
#define TOUCHDOWN_TOUCHDOWN_H

/* Contact estimation in plain C. A program creates an estimator from a model file that
 * `touchdown fit` wrote. It passes one record per control step and gets one belief per record.
 * No exception leaves these functions. Two threads must not use the same estimator at once; they
 * may use different ones. */

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct touchdown_estimator touchdown_estimator;

/* What the program requires of the model. NULL or 0: no requirement, the model decides. */
typedef struct touchdown_use {
  const char* estimator; /* "load_filter", "robust", … */
  double sample_rate;    /* rate at which the program calls touchdown_update (Hz) */
  const char* robot;     /* "upkie", … */
} touchdown_use;

typedef struct touchdown_joint {
  double position; /* rad */
  double velocity; /* rad/s */
  double torque;   /* N·m */
} touchdown_joint;

/* The measurements of one control step. NaN: not reported. Unless touchdown_set_conventions states
 * other ones, they are in Upkie's signs, units and frames:
 * - Left hip and knee are positive forward, the right leg is their mirror image. Left wheel + and
 *   right wheel - drive forward.
 * - The IMU has x back, y left and z down. Orientation, angular velocity and both accelerations are
 *   in this one frame. An IMU with x forward gives roll and yaw rates of the opposite sign, and
 *   nothing here can notice. */
typedef struct touchdown_record {
  double time;                    /* s; only differences matter */
  touchdown_joint joint[6];       /* left hip, knee, wheel, right hip, knee, wheel */
  double orientation[4];          /* w x y z; from the IMU's frame to x forward, y right, z down */
  double angular_velocity[3];     /* of the IMU, in its frame (rad/s) */
  double linear_acceleration[3];  /* of the IMU, in its frame, without gravity (m/s²) */
  double proper_acceleration[3];  /* as the chip measures it (m/s²); detects an upside-down IMU */
  double ground_velocity_command; /* of the policy, at the previous step (m/s) */
} touchdown_record;

/* The command of one servo, with the law torque = kp (position - measured position) +
 * kd (velocity - measured velocity) + feedforward_torque. NaN: not known. */
typedef struct touchdown_target {
  double position;           /* rad */
  double velocity;           /* rad/s */
  double feedforward_torque; /* N·m */
  double kp;                 /* N·m/rad */
  double kd;                 /* N·m·s/rad */
} touchdown_target;

/* How one of Upkie's joints follows from one of the record's:
 * ours = sign (scale unit theirs - zero). */
typedef struct touchdown_joint_source {
  size_t index; /* in touchdown_record's `joint`; 6 or more: the robot does not have it */
  double sign;  /* 1 or -1 */
  double zero;  /* their position at which ours is zero (rad) */
  /* Factors beside the units: a gear ratio, or a torque constant (N·m/A). A negative one is for a
   * velocity or a torque that is counted the other way than the position. */
  double position_scale;
  double velocity_scale;
  double torque_scale;
} touchdown_joint_source;

/* How a robot's records become Upkie's. The same as AssemblyConfig of the C++ library, and as the
 * keys `sign`, `zero`, `scale`, `unit`, `reference` and `axes` of a mapping file. */
typedef struct touchdown_conventions {
  touchdown_joint_source joint[6]; /* left hip, knee, wheel, right hip, knee, wheel */
  /* The size of each of the robot's units in ours. */
  double time_unit;                /* s */
  double position_unit;            /* rad */
  double velocity_unit;            /* rad/s */
  double torque_unit;              /* N·m */
  double angular_velocity_unit;    /* of the IMU, rad/s */
  double linear_acceleration_unit; /* of the IMU, m/s² */
  double kp_unit;                  /* N·m/rad */
  double kd_unit;                  /* N·m·s/rad */
  /* 0: linear_acceleration is used. 1: proper_acceleration, from which the orientation removes
   * gravity. */
  int uses_proper_acceleration;
  int reference_is_z_up; /* 1: the orientation is to a frame with z up (ROS, ENU), not down */
  /* Rotation from the axes of the robot's IMU to those of Upkie's. Row 0 is the direction that
   * points back, row 1 left and row 2 down, in the axes of the robot's IMU. An IMU with x forward,
   * y left and z up (REP 103) has {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}. */
  double imu_axes[3][3];
} touchdown_conventions;

enum touchdown_status {
  TOUCHDOWN_GOOD = 0,
  TOUCHDOWN_INVALID = 1, /* signals that are NaN or beyond their bounds: the belief relaxes */
  TOUCHDOWN_GAP = 2,     /* time jumped: the belief relaxes to the prior */
  TOUCHDOWN_FROZEN = 3,  /* a sensor repeats itself to the bit: the belief relaxes to the prior */
  TOUCHDOWN_DEGRADED = 4 /* used, but without servo targets, which load_filter can use */
};

/* Faults of a record, one bit each. */
enum touchdown_fault {
  TOUCHDOWN_JOINT_MISSING = 1,         /* a position, velocity or torque is not finite */
  TOUCHDOWN_JOINT_STALE = 2,           /* a servo repeats itself to the bit */
  TOUCHDOWN_ORIENTATION_MISSING = 4,   /* the quaternion does not have length one */
  TOUCHDOWN_UPSIDE_DOWN = 8,           /* the orientation turns gravity upside down */
  TOUCHDOWN_ACCELERATION_MISSING = 16, /* neither acceleration is finite */
  TOUCHDOWN_CLOCK_MISSING = 32,        /* the time is not finite */
  TOUCHDOWN_CLOCK_BACK = 64,           /* time went back */
  TOUCHDOWN_CLOCK_GAP = 128,           /* records were lost */
  TOUCHDOWN_CLOCK_RATE = 256,          /* the records' rate is not the configured one */
  TOUCHDOWN_SIGNAL_STOPPED = 512       /* one signal repeats itself while the robot moves */
};

/* The estimate after one record. Arrays hold the left wheel, then the right wheel. */
typedef struct touchdown_belief {
  double p_contact[2];      /* P(this wheel is in contact) */
  int contact[2];           /* the estimator's decision; 1: in contact */
  double p_any_wheel;       /* P(at least one wheel is in contact) */
  double p_both_wheels;     /* P(both wheels are in contact) */
  int status;               /* enum touchdown_status */
  unsigned faults;          /* bits of enum touchdown_fault */
  int unusable;             /* the first that is NaN, beyond its bound or stopped; -1: none */
  double load[2];           /* normal force on this wheel (N); NaN: not known */
  double load_deviation[2]; /* its standard deviation (N) */
} touchdown_belief;

/* Returns a record to fill in: all its measurements are NaN, the command is 0. */
touchdown_record touchdown_empty_record(void);

/* Creates an estimator from a model file that `touchdown fit` or `touchdown convert` wrote. Without
 * one (NULL), it is load_filter with Upkie's legs. `use` may be NULL. The caller destroys the
 * estimator with touchdown_destroy. On failure, returns NULL and writes one line with the reason to
 * `error`, which has `error_size` bytes, terminating zero included; `error` may be NULL and
 * `error_size` 0. This function is in the component `models`, as are all that read a file. */
touchdown_estimator* touchdown_create(const char* model_path, const touchdown_use* use, char* error,
                                      size_t error_size);

/* Upkie's conventions: those of an estimator that was just created, to change what differs. */
touchdown_conventions touchdown_upkie_conventions(void);

/* Sets the conventions of the records that follow, and resets the estimator. Returns 1. For NULL,
 * units that are not positive, signs other than 1 and -1, or axes that are no rotation, returns 0,
 * changes nothing, and writes one line to `error` as touchdown_create does. */
int touchdown_set_conventions(touchdown_estimator* estimator,
                              const touchdown_conventions* conventions, char* error,
                              size_t error_size);

/* For legs with closed loops: reads the file that `touchdown check ROBOT --legs FILE` wrote. The
 * records that follow have in `joint` each leg's first motor, its second one (NaN: none) and its
 * wheel, with the signs and zeros of the robot's file. Resets the estimator; call it after
 * touchdown_set_conventions. Returns 1, or 0 as that does. In the component `models`. */
int touchdown_load_closed_legs(touchdown_estimator* estimator, const char* path, char* error,
                               size_t error_size);

/* Takes one record and returns the belief after it. Never fails, allocates or locks. Without an
 * estimator or a record (NULL), returns the flat prior with the status TOUCHDOWN_INVALID. */
touchdown_belief touchdown_update(touchdown_estimator* estimator, const touchdown_record* record);

/* The same with the commands that the servos executed when the record was measured, in the order of
 * its joints: those of the previous step. NULL: not known, as in touchdown_update. Only load_filter
 * uses them. */
touchdown_belief touchdown_update_with_targets(touchdown_estimator* estimator,
                                               const touchdown_record* record,
                                               const touchdown_target targets[6]);

/* Resets the estimator to its state after touchdown_create; NULL is allowed. */
void touchdown_reset(touchdown_estimator* estimator);

/* Frees the estimator; NULL is allowed. */
void touchdown_destroy(touchdown_estimator* estimator);

/* Describes the model: "robust, 1000 Hz, robot upkie, fingerprint …". The text is valid until the
 * estimator is destroyed; empty for NULL. */
const char* touchdown_model_text(const touchdown_estimator* estimator);

/* The name of an enum touchdown_status: "good", "invalid", "gap", "frozen" or "degraded"; empty
 * for others. */
const char* touchdown_status_text(int status);

/* The name of a touchdown_belief's `unusable` signal: "left hip position", "vertical acceleration",
 * …; empty for -1. */
const char* touchdown_signal_text(int signal);

/* The library's version, "1.0.0". */
const char* touchdown_version(void);

#ifdef __cplusplus
}
#endif

#endif
