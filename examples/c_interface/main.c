/* Contact estimation from C, with a simulated signal in place of your robot: it stands for 0.5 s,
 * falls for 0.2 s, and stands again. Without an argument the estimator is the load filter with
 * Upkie's legs. ROBOT.npz holds those of another robot, which `touchdown convert robot.yaml -o
 * ROBOT.npz` wrote, or a fitted model.
 *
 * Exit code 0 if the belief about the left wheel is right at the end of each phase. */

#include <stdio.h>
#include <touchdown/touchdown.h>

static int in_the_air(int step) { return step >= 500 && step < 700; }

static touchdown_record read_robot(int step) {
  const int air = in_the_air(step);
  const double noise = 1e-3 * (step * 7919 % 13 - 6);
  touchdown_record record = touchdown_empty_record();
  int leg;
  record.time = 1e-3 * step;
  for (leg = 0; leg < 2; ++leg) {
    const double sign = leg == 0 ? 1.0 : -1.0;
    const touchdown_joint hip = {0.455 * sign, noise, (air ? 0.1 : -2.0) * sign + noise};
    const touchdown_joint knee = {-0.791 * sign, noise, (air ? 0.05 : 1.3) * sign + noise};
    const touchdown_joint wheel = {0.01 * step * sign, 10.0 * sign,
                                   (air ? 0.0 : 0.2) * sign + noise};
    record.joint[3 * leg] = hip;
    record.joint[3 * leg + 1] = knee;
    record.joint[3 * leg + 2] = wheel;
  }
  record.orientation[0] = record.orientation[1] = record.orientation[2] = 0.0;
  record.orientation[3] = 1.0;
  record.angular_velocity[0] = record.angular_velocity[1] = record.angular_velocity[2] = noise;
  record.linear_acceleration[0] = record.linear_acceleration[1] = noise;
  record.linear_acceleration[2] = (air ? 9.81 : 0.0) + noise;
  return record;
}

int main(int argc, char** argv) {
  char error[300];
  const touchdown_use use = {NULL, 1000.0, "upkie"};
  touchdown_estimator* estimator;
  int right = 1;
  int step;
  if (argc > 2) {
    fprintf(stderr, "usage: c_interface [ROBOT.npz]\n");
    return 2;
  }
  estimator = touchdown_create(argc == 2 ? argv[1] : NULL, &use, error, sizeof error);
  if (estimator == NULL) {
    fprintf(stderr, "%s\n", error);
    return 2;
  }
  printf("%s\n", touchdown_model_text(estimator));
  for (step = 0; step < 1200; ++step) {
    const touchdown_record record = read_robot(step);
    const touchdown_belief belief = touchdown_update(estimator, &record);
    if (step == 499 || step == 699 || step == 1199) {
      printf("%.3f s: left wheel %s, P(contact) %.6f, load %.1f N, signals %s\n", record.time,
             belief.contact[0] ? "in contact" : "in the air", belief.p_contact[0], belief.load[0],
             touchdown_status_text(belief.status));
      right = right && belief.contact[0] == !in_the_air(step);
    }
  }
  touchdown_destroy(estimator);
  return right ? 0 : 1;
}
